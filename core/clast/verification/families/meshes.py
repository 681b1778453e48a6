"""Meshes: walls of triangles, beside a plate, and beside closed forms."""

from __future__ import annotations

from math import sqrt

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.hertz import effective_modulus
from clast.verification.curves import Floats
from clast.verification.finding import Finding
from clast.verification.reading import follow, position, spin, velocity
from clast.verification.sketch import Line, Sketch

CUT, WHOLE, FUNNEL, RIDGE = range(4)
"""Numbers of the spheres."""

G, LOOK = 9.81, 100
FACES, RIM, HEIGHT = 24, 20e-3, 30e-3
"""Of the funnel: faces, radius of its corners and height of its rim in m."""

ROUNDING, STIFF, SETTLED, HEIGHTS = 1e-9, 2e-2, 1e-4, 1e-6
"""Accuracy of what is the same but for rounding, of impacts of stiff bodies, of forces at rest, of heights there."""


def moment(simulation: Simulation) -> Floats:
    """Return place, velocity and spin of both spheres on plates, (2, 9): place and the rest in units of their size."""
    radius = simulation.scene.radius[CUT]
    place = position(simulation)[[CUT, WHOLE]] - simulation.scene.position[[CUT, WHOLE]]
    speed, turning = velocity(simulation)[[CUT, WHOLE]], radius * spin(simulation)[[CUT, WHOLE]]
    return np.hstack([place / radius, speed / 0.1, turning / 0.1])


def judge_plate(bench: Bench) -> Findings:
    """Let two spheres slide until they roll: over edges and corners between triangles, and over none."""
    simulation = bench.start()
    told = follow(simulation, moment, LOOK)
    time: Floats = np.asarray(LOOK * simulation.dt * np.arange(len(told)))
    error = float(np.abs(told[:, 0] - told[:, 1]).max())
    yield Finding("place, velocity and spin: largest difference, in sizes", 0.0, error, ROUNDING, True)
    last = told[-1, 0]
    yield Finding("speed of rolling over that of sliding at first", 5.0 / 7.0, float(last[3] / told[0, 0, 3]), STIFF)
    lines = (
        Line("plate: speed", time, told[:, 1, 3]),
        Line("triangles: speed", time[::10], told[::10, 0, 3], dots=True),
        Line("plate: r ω", time, told[:, 1, 7]),
        Line("triangles: r ω", time[::10], told[::10, 0, 7], dots=True),
    )
    yield Sketch("a sphere on a plate cut into triangles", "time, s", "speed along x, 0.1 m/s", lines)


def judge_funnel(bench: Bench) -> Findings:
    """Let a sphere settle in a funnel: it touches every face once, as deep as a share of its weight presses it."""
    simulation = bench.run()
    scene = simulation.scene
    r, m = float(scene.radius[FUNNEL]), float(scene.mass[FUNNEL])
    slope = np.arctan(RIM * np.cos(np.pi / FACES) / HEIGHT)
    modulus = effective_modulus(scene.config.materials["glass"], scene.config.materials["slick"])
    overlap = (0.75 * m * G / (FACES * np.sin(slope)) / (modulus * sqrt(r))) ** (2.0 / 3.0)
    height = (r - overlap) / float(np.sin(slope))
    yield Finding("height over the tip, m", height, float(position(simulation)[FUNNEL, 2]), HEIGHTS)
    funnel = list(scene.config.walls).index("funnel")
    walls, pairs = simulation.world.walls, simulation.world.wall_pairs
    yield Finding("force on the funnel, N", m * G, -float(walls.force[funnel, 2]), SETTLED)
    yield Finding("faces that are touched", FACES, float(pairs.touching[pairs.wall == funnel].sum()), 0.0)


def judge_ridge(bench: Bench) -> Findings:
    """Let a sphere fall on a ridge, half a radius beside it: it is turned aside by twice the angle."""
    simulation = bench.start()
    scene = simulation.scene
    start, speed, r = scene.position[RIDGE], float(-scene.velocity[RIDGE, 2]), float(scene.radius[RIDGE])
    across = float((start[0] - 50e-3) / r)
    up = sqrt(1.0 - across**2)
    met = sqrt(speed**2 + 2.0 * G * float(start[2] - up * r))
    simulation.advance_to(round(4e-3 / simulation.dt))
    got = velocity(simulation)[RIDGE] + np.array([0.0, 0.0, G * simulation.time - (met - speed)])
    expected = 2.0 * met * up * np.array([across, 0.0, up]) - np.array([0.0, 0.0, met])
    yield Finding("velocity away from the ridge, m/s", float(expected[0]), float(got[0]), STIFF)
    yield Finding("velocity upwards, m/s", float(expected[2]), float(got[2]), STIFF)
    yield Finding("velocity along the ridge, m/s", 0.0, float(abs(got[1])), ROUNDING, True)


FAMILY = Family(
    "meshes",
    "Walls of triangles",
    "A surface of triangles is touched where it is nearest: once on a flat face, however it is cut, once on each face "
    "of a hollow, once on a ridge.",
    (
        Case(
            "mesh_plate",
            "a sphere rolls over triangles",
            "mesh",
            judge_plate,
            "the same as on a plate that is not cut, to rounding; rolling at 5/7 of the speed of sliding",
        ),
        Case(
            "mesh_funnel",
            "a sphere settles in a funnel",
            "mesh",
            judge_funnel,
            "height (r - δ)/sin α over the tip, α the slope of the faces, δ by Hertz from m g/(24 sin α) on each",
            (needs.hertzian,),
        ),
        Case(
            "mesh_ridge",
            "a sphere falls on a ridge",
            "mesh",
            judge_ridge,
            "reflection at the plane across the line from the ridge to the centre, of bodies that hardly give way",
        ),
    ),
)
