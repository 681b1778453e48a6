"""Extremes: huge and tiny coordinates, and ten million steps."""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.config.scene import SceneConfig
from tests.stability.entry import ACCURATE, REFUSED, Answer, Entry, Group, Ran
from tests.stability.measures import angular_momentum, energy, growth, rebound, worst
from tests.stability.scenes import bonded, impact_duration, pair, particle, spheres

LONG = 10_000_000


def moved(offset: float, expected: str = ACCURATE) -> Entry:
    """Return a head-on impact of millimetre spheres far from the origin."""
    name = f"1 mm spheres, {offset:g} m from the origin"
    return Entry(name, lambda: pair(offset=offset), lambda ran: rebound(ran, 1.0, 0.01), expected, offset == 1e8)


def scaled(radius: float) -> Entry:
    """Return a head-on impact of spheres of some size."""
    away = {"walls.floor.point": [0, 0, -100.0 * radius]}
    return Entry(
        f"radius {radius:g} m", lambda: pair(radii=(radius, radius), changes=away), lambda ran: rebound(ran, 1.0, 0.01)
    )


def moved_bond(offset: float, expected: str = ACCURATE) -> Entry:
    """Return a spinning, stretching pair far from the origin."""
    name = f"a bond of 2.1 mm, {offset:g} m from the origin"
    return Entry(name, lambda: spinning_pair(20_000, offset), lambda ran: steady(ran, 1e-3), expected)


def spinning_pair(steps: int, offset: float = 0.0, changes: dict[str, Any] | None = None) -> SceneConfig:
    """Return two bonded spheres that stretch, bend, twist and spin."""
    made = [
        particle(offset + np.array([-1.05e-3, 0, 0]), 1e-3, [0.1, -0.5, 0], [20, 0, 300]),
        particle(offset + np.array([1.05e-3, 0, 0]), 1e-3, [-0.1, 0.5, 0], [-20, 30, 500]),
    ]
    given = {
        "time.end": {"steps": steps},
        "time.step": {"rule": "spectral", "factor": 0.2},
        "output.samples": min(20_000, steps // 10),
    }
    return bonded(made, [(0, 1)], given | dict(changes or {}))


def steady(ran: Ran, bound: float) -> Answer:
    """Ask that the energy and the angular momentum stay, from the first quarter of a run to its last."""
    L = np.linalg.norm(angular_momentum(ran), axis=1)
    return Answer("energy and angular momentum stay", max(abs(growth(energy(ran))), abs(growth(L))), bound)


def bouncing(steps: int) -> SceneConfig:
    """Return a sphere that bounces on an elastic floor."""
    step = 0.02 * impact_duration(0.5, (1e-3,))
    made = [particle([0, 0, 1.1e-3], 1e-3), particle([0, 5, 0], 1e-3, prescribed=True, material="second")]
    changes = {
        "walls.floor.point": [0, 0, 0],
        "body_forces.0.acceleration": [0, 0, -9.81],
        "time.step": step,
        "time.end": {"steps": steps},
        "output.samples": 20_000,
    }
    return spheres(made, changes, "falling")


def as_high_as_ever(ran: Ran) -> Answer:
    """Ask that the highest point of the last tenth is that of the first."""
    z = ran.particles["position"][:, 0, 2] - 1e-3
    tenth = len(z) // 10
    return Answer("bounces as high as at first", worst(np.array([z[-tenth:].max() / z[:tenth].max() - 1.0])), 0.01)


GROUPS = (
    Group(
        "coordinates",
        "Huge and tiny coordinates",
        "Positions are 64-bit numbers: far from the origin their last digit is coarse beside an overlap.",
        (
            *map(moved, (0.0, 1.0, 1e3, 1e5)),
            *(moved(offset, REFUSED) for offset in (1e8, 1e12)),
            moved_bond(0.0),
            moved_bond(1e3),
            moved_bond(1e8, REFUSED),
            *map(scaled, (1e-9, 1e-6, 1.0, 1e3)),
        ),
    ),
    Group(
        "long",
        "Ten million steps",
        "Two bonded spheres stretch, bend, twist and spin; a sphere bounces on an elastic floor.",
        (
            Entry("bonded pair", lambda: spinning_pair(LONG), lambda ran: steady(ran, 1e-5)),
            Entry("bouncing sphere", lambda: bouncing(LONG), as_high_as_ever),
        ),
    ),
)
