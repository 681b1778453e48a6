"""Near bodies: the pairs, and the particles at walls, that a running scene looks at."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
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


class Nearness:
    """Where near bodies are: pairs of particles whose contact counts, and particles at walls.

    Most looks ask for no more than the largest overlap; the rest is sorted out when it is asked for.

    Parameters
    ----------
    world : World
    gaps : compiled function
        See :func:`clast.engine.kernels.gaps.gaps`.
    """

    def __init__(self, world: World, gaps: Gaps) -> None:
        self.world = world
        self.between, self.at_walls = np.empty((len(world.pairs.first), 4)), np.empty((len(world.wall_pairs.wall), 4))
        if len(self.between) or len(self.at_walls):
            gaps(world, self.between, self.at_walls)

    @property
    def largest(self) -> float:
        """Largest overlap of any two bodies in m, below 0 for a gap."""
        return max(float(found[:, 3].max(initial=-np.inf)) for found in (self.between, self.at_walls))

    @cached_property
    def pairs(self) -> Near:
        """Particles i and j; pairs in whose stead a bond holds are left out."""
        pairs, counts = self.world.pairs, self.between[:, 3] > -np.inf
        return _near(pairs.first[counts], pairs.second[counts], self.between[counts])

    @cached_property
    def walls(self) -> Near:
        """Wall and particle."""
        near, counts = self.world.wall_pairs, self.at_walls[:, 3] > -np.inf
        return _near(near.wall[counts], near.particle[counts], self.at_walls[counts])


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
