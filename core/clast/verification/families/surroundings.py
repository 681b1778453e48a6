"""Surroundings: walls of all shapes, how they move, and what pulls everywhere, each beside a closed form."""

from __future__ import annotations

from math import pi, sqrt
from typing import Any

import numpy as np

from clast.config.columns import wall_columns
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.asking import Asking
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.hertz import effective_modulus
from clast.verification.curves import Floats
from clast.verification.finding import Finding
from clast.verification.reading import evaluation, follow, position, velocity
from clast.verification.sketch import Line, Sketch

G = 9.81
LOOK, FINE = 100, 10
"""Steps between two looks, and between two at which conditions are asked."""

SEEN = 5e-3
"""When the impact on the loose plate is over, in s."""

BOWL, EDGE, TABLE, LOOSE, PRESSED = range(5)
"""Numbers of the spheres."""

STIFF, SMOOTH, EXACT, ROUNDING = 1e-2, 1e-4, 1e-8, 1e-11
"""Accuracy of closed forms of stiff bodies, that touch in a point; of what changes slowly; of sums of steps, within
which a wall keeps one velocity; and of sums of ways that are known."""

TURNED = 0.02
"""How far a press may go beyond the way at which it turns: by that between two looks."""


def wall(simulation: Simulation, name: str) -> int:
    """Return the number of a wall."""
    return list(simulation.scene.config.walls).index(name)


def parameters(simulation: Simulation, name: str) -> Any:
    """Return what is written for the shape of a wall."""
    return simulation.scene.config.walls[name].shape.params


def moving(simulation: Simulation, name: str) -> Any:
    """Return what is written for the motion of a wall."""
    motion = simulation.scene.config.walls[name].motion
    assert motion is not None
    return motion.params


def judge_bowl(bench: Bench) -> Findings:
    """Let a sphere slide down a bowl without friction: a pendulum."""
    simulation = bench.start()
    start, radius = simulation.scene.position[BOWL], float(simulation.scene.radius[BOWL])
    length = parameters(simulation, "bowl").radius - radius
    angle = float(np.arctan2(start[0], -start[2]))
    aside, speed = follow(simulation, lambda at: (position(at)[BOWL, 0], abs(velocity(at)[BOWL, 0])), LOOK)
    time: Floats = np.asarray(LOOK * simulation.dt * np.arange(len(aside)))
    period = 2.0 * pi * sqrt(length / G) * (1.0 + angle**2 / 16.0)
    k = int(np.nonzero(aside < 0.0)[0][0])
    through = time[k - 1] + (time[k] - time[k - 1]) * aside[k - 1] / (aside[k - 1] - aside[k])
    yield Finding("quarter of a period, s", 0.25 * period, float(through), SMOOTH)
    yield Finding("speed in the middle, m/s", sqrt(2.0 * G * length * (1.0 - np.cos(angle))), float(speed[k]), SMOOTH)
    swing = start[0] * np.cos(2.0 * pi * time / period)
    lines = (Line("pendulum", time, np.asarray(1e3 * swing)), Line("Clast", time[::50], 1e3 * aside[::50], dots=True))
    yield Sketch("a sphere in a bowl", "time, s", "distance from the middle, mm", lines)


def judge_edge(bench: Bench) -> Findings:
    """Let a sphere fall on the edge of a block, half a radius beside it: it is turned aside by twice the angle."""
    simulation = bench.start()
    scene, block = simulation.scene, parameters(simulation, "block")
    start, speed = scene.position[EDGE], float(-scene.velocity[EDGE, 2])
    across = float((start[0] - block.upper[0]) / scene.radius[EDGE])
    up = sqrt(1.0 - across**2)
    fall = float(start[2] - block.upper[2] - up * scene.radius[EDGE])
    met = sqrt(speed**2 + 2.0 * G * fall)
    simulation.advance_to(round(2.0 * fall / met / simulation.dt))
    got = velocity(simulation)[EDGE] + np.array([0.0, 0.0, G * simulation.time - (met - speed)])
    expected = 2.0 * met * up * np.array([across, 0.0, up]) - np.array([0.0, 0.0, met])
    yield Finding("velocity away from the block, m/s", float(expected[0]), float(got[0]), STIFF)
    yield Finding("velocity upwards, m/s", float(expected[2]), float(got[2]), STIFF)
    yield Finding("velocity along the edge, m/s", 0.0, float(abs(got[1])), 0.0, True)


def judge_shaker(bench: Bench) -> Findings:
    """Shake a sphere on a table, more gently than it would jump: the force on the table is m (g + A ω² cos ω t)."""
    simulation = bench.start()
    table, swing = wall(simulation, "table"), moving(simulation, "table")
    m, omega, height = float(simulation.scene.mass[TABLE]), 2.0 * pi * swing.frequency, swing.amplitude[2]
    told = follow(
        simulation,
        lambda at: (at.world.walls.force[table, 2], at.world.walls.displacement[table, 2]),
        LOOK,
    )
    force, place = -told[0], told[1]
    time = np.minimum(LOOK * np.arange(len(force)), simulation.last_step) * simulation.dt
    path = height * (np.cos(omega * time) - 1.0)
    error = float(np.abs(place - path).max() / height)
    yield Finding("displacement: largest error, share of the amplitude", 0.0, error, 1e-6, True)
    settled = time > 0.1
    yield Finding("largest force, N", m * (G + height * omega**2), float(force[settled].max()), STIFF)
    yield Finding("smallest force, N", m * (G - height * omega**2), float(force[settled].min()), STIFF)
    closed = m * (G - height * omega**2 * np.cos(omega * time))
    shown = slice(-1200, None)
    lines = (
        Line("m (g + a)", time[shown], 1e3 * closed[shown]),
        Line("Clast", time[shown][::40], 1e3 * force[shown][::40], dots=True),
    )
    yield Sketch("a sphere on a shaken table", "time, s", "force, mN", lines)


def judge_free(bench: Bench) -> Findings:
    """Let a sphere run into a loose plate, and a plate fall."""
    simulation = bench.start()
    m, big = float(simulation.scene.mass[LOOSE]), moving(simulation, "loose").mass
    speed = -float(simulation.scene.velocity[LOOSE, 0])
    simulation.advance_to(round(SEEN / simulation.dt))
    walls, t = simulation.world.walls, simulation.time
    plate, sphere = -walls.velocity[wall(simulation, "loose"), 0], -velocity(simulation)[LOOSE, 0]
    yield Finding("plate after the impact, m/s", 2.0 * m * speed / (m + big), float(plate), SMOOTH)
    yield Finding("sphere after the impact, m/s", (m - big) * speed / (m + big), float(sphere), SMOOTH)
    yield Finding("momentum of both, kg m/s", m * speed, float(m * sphere + big * plate), EXACT)
    fallen, course = walls.displacement[wall(simulation, "falling"), 2], moving(simulation, "falling")
    expected = course.velocity[2] * t + 0.5 * course.gravity[2] * t**2
    yield Finding("way of the falling plate, m", expected, float(fallen), EXACT)


def judge_table(bench: Bench) -> Findings:
    """Follow a plate that goes by a table of displacements, over and over, with rows between the steps."""
    simulation = bench.start()
    guided, rows = wall(simulation, "guided"), np.array(moving(simulation, "guided").displacement)
    since = (1.0 - evaluation(simulation)) * simulation.dt

    def at_forces(at: Simulation) -> Any:
        return at.world.walls.displacement[guided] - since * at.world.walls.velocity[guided]

    place = follow(simulation, at_forces, LOOK)[1:]
    time = np.minimum(LOOK * np.arange(1, len(place) + 1), simulation.last_step) * simulation.dt - since
    expected = np.interp(time, rows[:, 0], rows[:, 1], period=float(rows[-1, 0]))
    size = float(np.ptp(rows[:, 1]))
    error = float(np.abs(place[:, 2] - expected).max()) / size
    yield Finding("place where forces see it: largest error, share of the way", 0.0, error, ROUNDING, True)
    yield Finding("largest displacement, m", float(expected.max()), float(place[:, 2].max()), ROUNDING)
    shown = time <= 2.0 * rows[-1, 0]
    lines = (
        Line("table", time[shown], 1e3 * expected[shown]),
        Line("Clast", time[shown][::10], 1e3 * place[shown, 2][::10], dots=True),
    )
    yield Sketch("a plate that follows a table", "time, s", "displacement, mm", lines)


def judge_stages(bench: Bench) -> Findings:
    """Press a sphere to a force, let go of it almost, and press it again: the press turns where Hertz has the force."""
    simulation = bench.start()
    scene, press = simulation.scene, wall(simulation, "press")
    ball, table = scene.config.materials["glass"], scene.config.materials["table"]
    modulus = effective_modulus(ball, table)

    def read(at: Simulation) -> dict[str, float]:
        walls = at.world.walls
        force = dict(zip(wall_columns(["press"]), walls.force[press].tolist(), strict=False))
        way, stage = -float(walls.displacement[press, 2]), float(walls.stage[press, 0])
        return {"time_s": at.time, "way": way, "stage": stage, **force}

    asking = Asking(simulation, FINE, read)
    simulation.run([asking])
    way, stage, force = (np.array([row[name] for row in asking.rows]) for name in ("way", "stage", "force_press_z_N"))
    for k, settings in enumerate(scene.config.walls["press"].stages):
        until: Any = settings.until.params if settings.until is not None else None
        turned = until.above if until.above is not None else until.below
        expected = 2.0 * (0.75 * turned / (modulus * sqrt(scene.radius[PRESSED]))) ** (2.0 / 3.0)
        yield Finding(f"way at the end of stage {k + 1}, m", expected, float(way[stage == k][-1]), TURNED)
    yield Finding("stages that are over", 3.0, float(stage[-1]), 0.0)
    closed = 4.0 / 3.0 * modulus * sqrt(scene.radius[PRESSED]) * (0.5 * np.maximum(way, 0.0)) ** 1.5
    lines = (Line("Hertz", 1e3 * way, closed), Line("Clast", 1e3 * way[::25], force[::25], dots=True))
    yield Sketch("a sphere that is pressed in stages", "way of the press, mm", "force, N", lines)


def judge_frame(bench: Bench) -> Findings:
    """Watch free flight in a frame that turns: in the frame at rest it is straight."""
    simulation = bench.start()
    frame: Any = simulation.scene.config.body_forces[0].params
    spin, point = np.array(frame.spin), np.array(frame.point)
    x, v = simulation.scene.position[0] - point, simulation.scene.velocity[0]
    places = follow(simulation, lambda at: position(at)[0], LOOK)
    time = np.minimum(LOOK * np.arange(len(places)), simulation.last_step) * simulation.dt
    straight = x + np.outer(time, v + np.cross(spin, x))
    seen = point + turned_back(straight, spin, time)
    way = float(np.linalg.norm(seen - seen[0], axis=1).max())
    error = float(np.linalg.norm(places - seen, axis=1).max())
    yield Finding("largest error of the place, share of the way", 0.0, error / way, 1e-5, True)
    lines = (
        Line("straight, seen from the frame", 1e3 * seen[:, 0], 1e3 * seen[:, 1]),
        Line("Clast", 1e3 * places[::10, 0], 1e3 * places[::10, 1], dots=True),
    )
    yield Sketch("free flight in a frame that turns", "x, mm", "y, mm", lines, round=True)


def turned_back(vectors: Floats, spin: Floats, time: Floats) -> Floats:
    """Return vectors, (n, 3), turned about ``spin`` by minus the angle it has come to at each time."""
    rate = float(np.linalg.norm(spin))
    axis, angle = spin / rate, -rate * time[:, None]
    along = (vectors @ axis)[:, None] * axis
    return np.asarray(along + np.cos(angle) * (vectors - along) + np.sin(angle) * np.cross(axis, vectors))


FAMILY = Family(
    "surroundings",
    "Walls, their motions, and body forces",
    "Spheres without friction tell what surrounds them: one swings in a bowl as a pendulum, one is turned aside by the "
    "edge of a block, one is shaken on a table, one runs into a loose plate; one flies freely in a frame that turns; "
    "a plate follows a table, and another presses a sphere in stages.",
    (
        Case(
            "wall_bowl",
            "a sphere slides in a spherical bowl",
            "surroundings",
            judge_bowl,
            "a pendulum of the length R - r: 2 π √((R - r)/g) (1 + θ²/16), θ the largest angle",
        ),
        Case(
            "wall_edge",
            "a sphere falls on the edge of a block",
            "surroundings",
            judge_edge,
            "reflection at the plane across the line from the edge to the centre, of bodies that hardly give way",
        ),
        Case(
            "motion_shaker",
            "a sphere on a table that swings",
            "surroundings",
            judge_shaker,
            "it goes with the table: m (g - A ω² cos ω t)",
        ),
        Case(
            "motion_free",
            "a plate that is free to move",
            "surroundings",
            judge_free,
            "elastic impact of two bodies: 2 m v/(m + M) and (m - M) v/(m + M); free fall",
        ),
        Case(
            "motion_table",
            "a plate that follows a table",
            "surroundings",
            judge_table,
            "the displacements of the table, with straight lines between the rows, over and over",
        ),
        Case(
            "motion_stages",
            "a sphere that is pressed, let go and pressed again",
            "surroundings",
            judge_stages,
            "Hertz: a force F is reached when both contacts together give way by 2 (3 F/(4 E* √r))^(2/3)",
            (needs.hertzian,),
        ),
        Case(
            "force_frame",
            "free flight in a rotating frame",
            "rotating_frame",
            judge_frame,
            "x(t) turned back by the angle Ω t of x0 + (v0 + Ω x x0) t",
        ),
    ),
)
