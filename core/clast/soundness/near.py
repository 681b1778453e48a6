"""Near bodies: the pairs, and the particles at walls, that a running scene looks at."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np

from clast.engine.blueprint import Blueprint
from clast.engine.kernels.layout import FIRST, RADIUS, X
from clast.engine.records import build, width
from clast.engine.state import Floats, Integers, World
from clast.maths.vec3 import ZERO
from clast.parts.contact_law import Touch
from clast.scene.plan import material_pairs, wall_shapes
from clast.scene.scene import Scene


class Pairs(NamedTuple):
    """Near pairs, one row each: particles i and j, unit vectors from i to j, overlaps in m (gaps are below 0)."""

    i: Integers
    j: Integers
    normal: Floats
    overlap: Floats


class AtWall(NamedTuple):
    """A particle near a wall: their numbers, the unit vector to the wall, and the overlap in m (a gap below 0)."""

    wall: int
    particle: int
    normal: Floats
    overlap: float


def near_pairs(world: World, plan: Blueprint) -> Pairs:
    """Return the near pairs whose contact counts: not those in whose stead a bond holds."""
    pairs, pose = world.pairs, world.particles.pose
    counts = (pairs.sides & FIRST) > 0
    if plan.contacts is None or not plan.contacts.bonded_pairs:
        counts &= pairs.bond < 0
    i, j = pairs.first[counts].astype(np.int64), pairs.second[counts].astype(np.int64)
    d = pose[j, X : X + 3] - pose[i, X : X + 3]
    distance = np.linalg.norm(d, axis=1)
    normal = d / np.where(distance > 0.0, distance, 1.0)[:, None]
    return Pairs(i, j, normal, pose[i, RADIUS] + pose[j, RADIUS] - distance - pairs.rest[counts])


def at_walls(world: World, scene: Scene) -> Iterator[AtWall]:
    """Yield the particles near walls."""
    near, pose = world.wall_pairs, world.particles.pose
    shapes = wall_shapes(scene) if len(near.wall) else []
    for w, k in zip(near.wall.tolist(), near.particle.tolist(), strict=True):
        nearest, shape = shapes[w]
        found = nearest(shape, tuple((pose[k, X : X + 3] - world.walls.displacement[w]).tolist()))
        yield AtWall(w, k, np.array(found.normal), float(pose[k, RADIUS] - found.distance))


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
