"""Rigid bodies: a plank that a ball strikes off its middle, a board that strikes a held one, a block that tumbles."""

from __future__ import annotations

from math import sqrt

import numpy as np

from clast.engine.state import Floats
from clast.engine.wall_frames import now
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.families.surroundings import moving, wall
from clast.verification.finding import Finding
from clast.verification.reading import follow, position, velocity
from clast.verification.sketch import Line, Sketch

BALL, HELD, STRUCK, LOOK = 0, 1, 10e-3, 20
EXACT, SMOOTH, DAMPED = 1e-10, 2e-3, 1e-2


def judge_struck(bench: Bench) -> Findings:
    """Let a ball strike a plank off its middle."""
    simulation = bench.start()
    plank, m = moving(simulation, "plank"), float(simulation.scene.mass[BALL])
    x, y, _ = (simulation.scene.position[BALL] - np.array(plank.centre)).tolist()
    speed = -float(simulation.scene.velocity[BALL, 2])
    before = momenta(simulation)
    simulation.advance_to(round(STRUCK / simulation.dt))
    push = 2.0 * speed / (1.0 / m + 1.0 / plank.mass + y**2 / plank.inertia[0] + x**2 / plank.inertia[1])
    k = wall(simulation, "plank")
    after, spin = velocity(simulation)[BALL, 2], simulation.world.walls.twist[k, 3:]
    yield Finding("ball after the impact, m/s", push / m - speed, float(after), SMOOTH)
    yield Finding("middle of the plank, m/s", -push / plank.mass, float(simulation.world.walls.velocity[k, 2]), SMOOTH)
    yield Finding("plank about x, rad/s", -y * push / plank.inertia[0], float(spin[0]), SMOOTH)
    yield Finding("plank about y, rad/s", x * push / plank.inertia[1], float(spin[1]), SMOOTH)
    linear, angular = momenta(simulation) - before
    yield Finding("change of momentum, share of the ball's", 0.0, worst(linear) / (m * speed), EXACT, True)
    yield Finding("change of angular momentum, share", 0.0, worst(angular) / (x * m * speed), EXACT, True)


def judge_held(bench: Bench) -> Findings:
    """Let a board strike a ball that is held, off its middle."""
    simulation = bench.start()
    board = moving(simulation, "board")
    x, y, _ = (simulation.scene.position[HELD] - np.array(board.centre)).tolist()
    contacts = simulation.scene.config.contacts
    pair = contacts.pair("glass", "wood") if contacts is not None else None
    assert pair is not None
    simulation.advance_to(round(STRUCK / simulation.dt))
    speed = -board.velocity[2]
    push = (1.0 + pair.restitution) * speed / (1.0 / board.mass + y**2 / board.inertia[0] + x**2 / board.inertia[1])
    k = wall(simulation, "board")
    flies, spin = float(simulation.world.walls.velocity[k, 2]), simulation.world.walls.twist[k, 3:].tolist()
    yield Finding("middle of the board, m/s", push / board.mass - speed, flies, DAMPED)
    yield Finding("board about x, rad/s", y * push / board.inertia[0], spin[0], DAMPED)
    yield Finding("board about y, rad/s", -x * push / board.inertia[1], spin[1], DAMPED)


def momenta(simulation: Simulation) -> Floats:
    """Return momentum in kg m/s and angular momentum in kg m²/s of ball and plank together, (2, 3)."""
    k, plank = wall(simulation, "plank"), moving(simulation, "plank")
    walls, m = simulation.world.walls, float(simulation.scene.mass[BALL])
    ball, middle = position(simulation)[BALL], walls.displacement[k] + walls.centre[k]
    thrown, carried = m * velocity(simulation)[BALL], plank.mass * walls.velocity[k]
    turning = angular_momentum(simulation, "plank")
    return np.array([thrown + carried, np.cross(ball, thrown) + np.cross(middle, carried) + turning])


def angular_momentum(simulation: Simulation, name: str) -> Floats:
    """Return the angular momentum of a body about its centre of mass, (3,) in kg m²/s."""
    k, inertia = wall(simulation, name), np.array(moving(simulation, name).inertia)
    turned = now(simulation.world.walls).turned_by(k)
    return np.asarray(turned @ (inertia * (turned.T @ simulation.world.walls.twist[k, 3:])))


def worst(vector: Floats) -> float:
    """Return the largest component of a vector."""
    return float(np.abs(vector).max())


def judge_tumbling(bench: Bench) -> Findings:
    """Follow a block that nothing touches."""
    simulation = bench.start()
    k, block = wall(simulation, "block"), moving(simulation, "block")
    inertia = np.array(block.inertia)

    def look(at: Simulation) -> tuple[Floats, Floats]:
        spin = at.world.walls.twist[k, 3:]
        turned = now(at.world.walls).turned_by(k)
        own = turned.T @ spin
        return own, turned @ (inertia * own)

    spins, momentum = (seen[1:] for seen in follow(simulation, look, LOOK))  # walls begin with the first step
    time = np.minimum(LOOK * np.arange(1, len(spins) + 1), simulation.last_step) * simulation.dt
    expected, size = tumbling(inertia, block.spin, time), float(np.abs(block.spin).max())
    yield Finding("spin in its own frame: largest error, share", 0.0, worst(spins - expected) / size, 1e-4, True)
    energy = 0.5 * (inertia * spins**2).sum(axis=1)
    yield Finding("energy: largest change, share", 0.0, float(np.ptp(energy) / energy[0]), 1e-6, True)
    drift = worst(momentum - momentum[0]) / float(np.linalg.norm(momentum[0]))
    yield Finding("angular momentum: largest change, share", 0.0, drift, EXACT, True)
    way = block.velocity[1] * simulation.time
    yield Finding("way, m", way, float(simulation.world.walls.displacement[k, 1]), EXACT)
    lines = [Line(f"about {name}, exact", time, expected[:, c]) for c, name in enumerate("xyz")]
    shown = [Line(f"about {name}, Clast", time[::60], spins[::60, c], dots=True) for c, name in enumerate("xyz")]
    yield Sketch("a block that tumbles, in its own frame", "time, s", "spin, rad/s", (*lines, *shown))


def tumbling(inertia: Floats, spin: tuple[float, float, float], time: Floats) -> Floats:
    """Return the spin of a free body in its own frame, (t, 3) in rad/s, which begins with none about the middle axis.

    Parameters
    ----------
    inertia : (3,) float64
        Rising moments of inertia in kg m².
    spin : three floats
        At the start, in rad/s: none about the second axis, and more about the third than about the first.
    time : (t,) float64
        In s.
    """
    from scipy.special import ellipj

    first, second, third = inertia.tolist()
    a, _, c = spin
    twice = first * a**2 + third * c**2
    square = (first * a) ** 2 + (third * c) ** 2
    pace = sqrt((third - second) * (square - twice * first) / (first * second * third))
    share = (second - first) * (twice * third - square) / ((third - second) * (square - twice * first))
    sn, cn, dn, _ = ellipj(pace * time, share)
    middle = sqrt((twice * third - square) / (second * (third - second)))
    return np.column_stack([a * cn, middle * sn, c * dn])


FAMILY = Family(
    "rigid_bodies",
    "Bodies that move and turn",
    "A ball strikes a loose plank off its middle, without friction: the two exchange one impulse, which the mass of "
    "the plank and both of its moments of inertia share. A board flies against a ball that is held, and keeps half of "
    "the speed there. A block that nothing touches turns over and over, as Euler's equations have it.",
    (
        Case(
            "struck_plank",
            "a ball strikes a plank off its middle",
            "rigid_bodies",
            judge_struck,
            "one impulse: 2 v / (1/m + 1/M + y²/I_x + x²/I_y)",
            (needs.full_restitution,),
        ),
        Case(
            "struck_ball",
            "a board strikes a ball that is held, off its middle",
            "rigid_bodies",
            judge_held,
            "one impulse: (1 + e) v / (1/M + y²/I_x + x²/I_y)",
            (needs.losses,),
        ),
        Case(
            "tumbling_block",
            "a block that tumbles",
            "rigid_bodies",
            judge_tumbling,
            "Euler's equations: Jacobi's elliptic functions, as in Landau and Lifshitz, Mechanics, § 37",
        ),
    ),
)
