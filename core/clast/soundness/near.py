"""Near bodies: the pairs, and the particles at walls, that a running scene looks at."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from clast.engine.blueprint import Blueprint
from clast.engine.records import build, width
from clast.engine.state import Floats, Integers, World
from clast.maths.vec3 import ZERO
from clast.parts.contact_law import Touch
from clast.scene.plan import material_pairs
from clast.scene.scene import Scene

Gaps = Callable[[World, Floats, Floats], None]


class Near(NamedTuple):
    """Near bodies, one row each: first and second, unit vectors from one to the other, overlaps in m (gaps below 0)."""

    first: Integers
    second: Integers
    normal: Floats
    overlap: Floats


class Nearness(NamedTuple):
    """Pairs of particles i and j whose contact counts, and particles at walls: wall and particle."""

    pairs: Near
    walls: Near


def look_around(world: World, gaps: Gaps) -> Nearness:
    """Return how near the bodies on the neighbour lists are; pairs in whose stead a bond holds are left out.

    Parameters
    ----------
    world : World
    gaps : compiled function
        See :func:`clast.engine.kernels.gaps.gaps`.
    """
    pairs, near = world.pairs, world.wall_pairs
    between, at_walls = np.empty((len(pairs.first), 4)), np.empty((len(near.wall), 4))
    if len(between) or len(at_walls):
        gaps(world, between, at_walls)
    counts = between[:, 3] > -np.inf
    return Nearness(
        _near(pairs.first[counts], pairs.second[counts], between[counts]), _near(near.wall, near.particle, at_walls)
    )


def _near(first: Any, second: Any, found: Floats) -> Near:
    return Near(first.astype(np.int64), second.astype(np.int64), found[:, :3], found[:, 3])


class Energies:
    """The elastic energy of the contacts of a scene, from its contact law."""

    def __init__(self, scene: Scene, plan: Blueprint) -> None:
        self.constants: dict[tuple[int, int], Any] = {}
        if plan.contacts is None or scene.config.contacts is None:
            return
        self.law, self.choices = plan.contacts.law, plan.contacts.choices
        history = self.law.History
        self.history = None if history is None else build(history, [0.0] * width(history))
        for i, j, pair in material_pairs(scene):
            found = self.law.constants(scene.config.contacts.law.params, pair)
            self.constants[i, j] = self.constants[j, i] = found

    def of(self, materials: tuple[int, int], radii: tuple[float, float], per_mass: float) -> Callable[[float], float]:
        """Return the energy in J of a contact without slip, as a function of its overlap in m.

        Parameters
        ----------
        materials : two ints
        radii : two floats
            In m; infinite for a wall.
        per_mass : float
            1/m_i + 1/m_j in 1/kg.
        """
        r_i, r_j = radii
        radius = 1.0 / (1.0 / r_i + 1.0 / r_j)
        second = r_j if r_j < np.inf else 0.0
        touch = Touch(0.0, (0.0, 0.0, 1.0), ZERO, ZERO, ZERO, radius, r_i, second, per_mass, 1.0)
        constants = self.constants[materials]
        return lambda overlap: float(
            self.law.energy(touch._replace(overlap=overlap), constants, self.history, self.choices)
        )
