"""Rigid grains of many primaries: what overlaps, and which forces and torques push them apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clast.maths.rotation import matrix, turn
from clast_plugins.generators.filling.room import Room

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

SKIN = 0.15
"""How far surfaces may approach each other before neighbours are looked for anew, in mean primary radii."""
TOUCHING = 0.01


@dataclass(frozen=True)
class Grains:
    """Rigid grains of primaries.

    Attributes
    ----------
    centre : (g, 3) float64
        Centres of mass in m.
    turned : (g, 4) float64
        Orientations, unit quaternions w, x, y, z.
    reach : (g,) float64
        Radius of a sphere about the centre that holds the whole grain, in m.
    volume : (g,) float64
        Volume of the primaries of each grain in m³.
    begin : (g + 1,) int64
        Where each grain's primaries begin.
    arm : (n, 3) float64
        Centre of each primary in its grain's frame in m.
    radius : (n,) float64
        In m.
    """

    centre: Floats
    turned: Floats
    reach: Floats
    volume: Floats
    begin: Ints
    arm: Floats
    radius: Floats

    @property
    def grain(self) -> Ints:
        """Number of the grain each primary belongs to, (n,)."""
        return np.repeat(np.arange(len(self.centre)), np.diff(self.begin))

    def positions(self) -> Floats:
        """Return the centres of all primaries, (n, 3) in m."""
        from clast_plugins.generators.filling.rigid_kernel import place_all

        position = np.empty_like(self.arm)
        place_all(self.centre, frames(self.turned), self.grain, self.arm, position)
        return position

    def move(self, velocity: Floats, spin: Floats, time: float) -> None:
        """Move and turn every grain with its velocity and spin, (g, 3) each, over some time."""
        self.centre[:] += time * velocity
        w, x, y, z = self.turned.T
        self.turned[:] = np.column_stack(turn((w, x, y, z), tuple(spin.T), time))


def frames(turned: Floats) -> Floats:
    """Return the rotation matrices (g, 3, 3) of unit quaternions (g, 4)."""
    w, x, y, z = turned.T
    return np.array(matrix((w, x, y, z)), np.float64).transpose(2, 0, 1).copy()


class Touch:
    """Finds what overlaps among rigid grains in a room, and how that pushes them.

    Attributes
    ----------
    force, torque : (g, 3) float64
        Of the last look, in m and m²: 1 per length of overlap.
    overlap : float
        The largest of the last look, in m.
    """

    def __init__(self, grains: Grains, room: Room) -> None:
        self.grains, self.room = grains, room
        self.gap = SKIN * float(grains.radius.mean())
        self.force, self.torque = np.zeros_like(grains.centre), np.zeros_like(grains.centre)
        self.overlap = 0.0
        self._listed_at: tuple[Floats, Floats, float] | None = None

    def look(self) -> None:
        """Find overlaps and pushes."""
        from clast_plugins.generators.filling.rigid_kernel import place_all, push_apart, push_inside

        if self._listed_at is None or self._moved() > 0.5 * self.gap:
            self._list()
        self.force[:] = self.torque[:] = 0.0
        centre, pushes = self.grains.centre, (self.force, self.torque)
        place_all(centre, frames(self.grains.turned), self._grain, self._arm, self._position)
        primaries = (self._position, self._radius, self._grain)
        between = push_apart(*primaries, self._pairs, centre, *pushes)
        outside = push_inside(*primaries, self._near, self.room.numbers, centre, *pushes)
        self.overlap = max(between, outside)

    def _moved(self) -> float:
        """Return the farthest that a surface can have gone since neighbours were listed, in m."""
        assert self._listed_at is not None
        centre, turned, lid = self._listed_at
        went = np.sqrt(((self.grains.centre - centre) ** 2).sum(axis=1))
        cosine = np.abs((self.grains.turned * turned).sum(axis=1))
        angle = 2.0 * np.sqrt(np.maximum(2.0 - 2.0 * cosine, 0.0))
        return max(float((went + angle * self.grains.reach).max()), abs(self.room.lid - lid))

    def _list(self) -> None:
        """List the primaries that may come to touch others, or the room, and keep only those."""
        grains, gap = self.grains, self.gap
        position, radius = grains.positions(), grains.radius
        pairs = list_pairs(grains, position, gap)
        walls = np.nonzero(self.room.gap(position) < radius + gap)[0]
        kept, place = np.unique(np.concatenate([pairs.ravel(), walls]), return_inverse=True)
        self._pairs, self._near = place[: pairs.size].reshape(-1, 2), place[pairs.size :]
        self._grain, self._arm, self._radius = grains.grain[kept], grains.arm[kept], radius[kept]
        self._position = position[kept]
        self._listed_at = (grains.centre.copy(), grains.turned.copy(), self.room.lid)


def list_pairs(grains: Grains, position: Floats, gap: float) -> Ints:
    """Return the pairs of primaries of different grains with a gap below ``gap`` in m, (p, 2)."""
    from clast_plugins.generators.filling.rigid_kernel import near_primaries

    couples = near_couples(grains.centre, grains.reach, gap)
    pairs = np.empty((4 * len(grains.radius), 2), np.int64)
    while True:
        count = near_primaries(grains.centre, grains.reach, couples, grains.begin, position, grains.radius, gap, pairs)
        if count <= len(pairs):
            return pairs[:count]
        pairs = np.empty((count, 2), np.int64)


def near_couples(centre: Floats, reach: Floats, gap: float) -> Ints:
    """Return the pairs of grains whose spheres are nearer than ``gap``, (c, 2) in rising order."""
    from scipy.spatial import cKDTree

    pairs = cKDTree(centre).query_pairs(2.0 * float(reach.max()) + gap, output_type="ndarray").astype(np.int64)
    pairs = np.sort(pairs, axis=1)
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    way = centre[pairs[:, 0]] - centre[pairs[:, 1]]
    apart = np.sqrt((way**2).sum(axis=1))
    return np.asarray(pairs[apart < reach[pairs].sum(axis=1) + gap])


def neighbours_touching(grains: Grains) -> float:
    """Return how many other grains touch a grain on average: with surfaces nearer than 1 % of a primary's diameter."""
    position, gap = grains.positions(), TOUCHING * 2.0 * float(grains.radius.mean())
    pairs = list_pairs(grains, position, gap)
    touching = np.unique(grains.grain[pairs], axis=0)
    return 2.0 * len(touching) / len(grains.centre)
