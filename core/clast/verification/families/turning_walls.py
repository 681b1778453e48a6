"""Turning walls: a ball on a turntable, and a sled on a ramp that is tilted."""

from __future__ import annotations

from math import atan, cos, sin
from typing import Any

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.families.surroundings import moving, wall
from clast.verification.finding import Finding
from clast.verification.reading import follow, position
from clast.verification.sketch import Line, Sketch

BALL, SLED = 0, (1, 2, 3)
G, LOOK = 9.81, 50
SLID = 1e-3
"""Way in m after which a sled counts as sliding."""


def judge_turntable(bench: Bench) -> Findings:
    """Let a ball roll on a turntable from where it is on its circle already."""
    simulation = bench.start()
    scene, rate = simulation.scene, float(moving(simulation, "table").rate)
    start, radius = scene.position[BALL], float(scene.radius[BALL])
    places, turned = follow(simulation, lambda at: (position(at)[BALL, :2], angle_of(at, "table")), LOOK)
    time = np.minimum(LOOK * np.arange(len(places)), simulation.last_step) * simulation.dt
    angle = np.unwrap(np.arctan2(places[:, 1], places[:, 0]))
    share = 0.4 * radius**2 / (0.4 * radius**2 + start[2] ** 2)
    far = np.hypot(places[:, 0], places[:, 1])
    yield Finding("rate of the ball, share of the table's", share, float(angle[-1] / (rate * time[-1])), 1e-3)
    yield Finding("distance from the axis: largest error, share of it", 0.0, worst_share(far, start[0]), 2e-3, True)
    yield Finding("angle of the table, rad", rate * time[-1], float(np.unwrap(turned, period=2.0 * np.pi)[-1]), 1e-9)
    ledger = simulation.ledger()
    yield Finding("energy missing or too much, share", 0.0, ledger.closure, 1e-3, True)
    round_ = rate * share * time
    circle = Line("rolls without slip", 1e3 * start[0] * np.cos(round_), 1e3 * start[0] * np.sin(round_))
    shown = Line("Clast", 1e3 * places[::80, 0], 1e3 * places[::80, 1], dots=True)
    yield Sketch("a ball on a turntable, seen from above", "x, mm", "y, mm", (circle, shown), round=True)


def judge_ramp(bench: Bench) -> Findings:
    """Tilt a ramp slowly until three bonded spheres slide down."""
    simulation = bench.start()
    config, rate = simulation.scene.config, float(moving(simulation, "ramp").rate)
    pair = config.contacts.pair("glass", "ramp") if config.contacts is not None else None
    assert pair is not None
    friction, expected = pair.sliding_friction, atan(pair.sliding_friction)
    centre = simulation.world.walls.centre[wall(simulation, "ramp")]
    before = along_ramp(simulation, centre, 0.0)
    while abs(along_ramp(simulation, centre, rate * simulation.time) - before) < SLID:
        simulation.advance_to(simulation.step + LOOK)
    steepening = (
        rate * G * (cos(expected) + friction * sin(expected))
    )  # how fast the sled's acceleration grows, in m/s³
    since = (6.0 * SLID / steepening) ** (1.0 / 3.0)
    yield Finding("angle at which it begins to slide, rad", expected, rate * (simulation.time - since), 0.01)


def along_ramp(simulation: Simulation, centre: Any, angle: float) -> float:
    """Return where the middle of the sled is along the slope of the ramp, in m."""
    y, z = (position(simulation)[list(SLED)].mean(axis=0) - centre)[1:]
    return float(y * cos(angle) + z * sin(angle))


def angle_of(simulation: Simulation, name: str) -> float:
    """Return by which angle a wall is turned about the vertical, in rad."""
    w, _, _, z = simulation.world.walls.pose[wall(simulation, name), 3:].tolist()
    return 2.0 * float(np.arctan2(z, w))


def worst_share(values: Any, expected: float) -> float:
    """Return the largest error of some values, as a share of what they should be."""
    return float(np.abs(values - expected).max() / expected)


FAMILY = Family(
    "turning_walls",
    "Walls that turn",
    "On a ramp that is tilted slowly, three spheres held by bonds slide from the angle of friction on. A ball that "
    "rolls on a turntable goes round, like a charge in a magnetic field, at a share I/(I + m R²) of the table's rate: "
    "2/7. R is its height above the table, a little less than its radius.",
    (
        Case(
            "tilted_ramp",
            "three spheres on a ramp that is tilted",
            "turning_walls",
            judge_ramp,
            "Coulomb: they slide where tan θ is the coefficient of friction, and then with g (sin θ - μ cos θ)",
            (needs.sticks,),
        ),
        Case(
            "turntable",
            "a ball rolls on a table that turns",
            "turning_walls",
            judge_turntable,
            "J. A. Burns (1981), American Journal of Physics 49, 56: circles at 2/7 of the rate",
            (needs.sticks,),
        ),
    ),
)
