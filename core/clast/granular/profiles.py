"""Profiles: solid fraction over height and over the distance from the axis, coordination number over height."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clast.granular.bed import Bed
from clast.granular.coordination import coordination_numbers
from clast.granular.cut_spheres import shell_volumes, slab_volumes
from clast.granular.grains import Grains
from clast.granular.pieces import Pieces

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Profile:
    """Shares of the room in ``b`` slabs or shells that something fills.

    Attributes
    ----------
    edges : (b + 1,) float64
        Heights over the lower plate as it was at the start, or distances from the axis, in m.
    solid : (b,) float64
        Share that primaries fill: 1 minus the total porosity. NaN without walls around.
    envelope : (b,) float64
        Share that fragments with their pores fill: 1 minus the porosity between them. NaN without walls around.
    coordination : (b,) float64
        Mean coordination number of the grains whose centres lie there; NaN where none does.
    """

    edges: Floats
    solid: Floats
    envelope: Floats
    coordination: Floats

    @property
    def middles(self) -> Floats:
        """Middle of each slab or shell in m, (b,)."""
        return 0.5 * (self.edges[1:] + self.edges[:-1])


@dataclass(frozen=True, eq=False)
class Packed:
    """A bed in one frame, ready to be cut into slabs and shells. ``n`` primaries, those that are there.

    Attributes
    ----------
    height, distance, radius : (n,) float64
        Height over the origin, distance from the axis, and radius of each primary, in m.
    porous : (n,) float64
        Envelope volume over solid volume of the fragment each is in.
    low, high : float
        Heights between which the bed lies, in m.
    """

    height: Floats
    distance: Floats
    radius: Floats
    porous: Floats
    low: float
    high: float

    @property
    def weights(self) -> Floats:
        """Factors that give the solid volume, and the envelope volume, (n, 2)."""
        return np.column_stack([np.ones(len(self.porous)), self.porous])


def packed(bed: Bed, grains: Grains, found: Pieces, position: Floats, extent: tuple[float, float]) -> Packed:
    """Return the primaries of a frame in the coordinates of the bed; loose particles fill room without pores."""
    there = np.isfinite(position[:, 0])
    porous = np.ones(len(position))
    held = found.of_primary >= 0
    porous[held] = (found.envelope / found.volume)[found.of_primary[held]]
    radius = np.cbrt(0.75 / np.pi * grains.primary_volume[there])
    return Packed(
        bed.heights(position[there]), bed.distances(position[there]), radius, porous[there], extent[0], extent[1]
    )


def over_height(of: Packed, section: float | None, bins: int, where: Floats, pairs: Ints) -> Profile:
    """Return the profile over the height of a bed.

    Parameters
    ----------
    of : Packed
    section : float or None
        Area in m² inside the walls around it.
    bins : int
    where : (g,) float64
        Height of each grain's centre in m.
    pairs : (c, 2) int64
        Grains in contact.
    """
    edges = np.linspace(of.low, of.high, bins + 1)
    room = np.diff(edges) * (np.nan if section is None else section)
    solid, envelope = slab_volumes(of.height, of.radius, edges, of.weights).T / room
    return Profile(edges, solid, envelope, _means(where, edges, pairs))


def over_radius(of: Packed, tube: float, bins: int, where: Floats, pairs: Ints) -> Profile:
    """Return the profile over the distance from the axis of a bed in a tube; ``where`` are distances of grains."""
    edges = np.linspace(0.0, tube, bins + 1)
    room = np.pi * np.diff(edges**2) * (of.high - of.low)
    solid, envelope = shell_volumes(of.distance, of.radius, edges, of.weights).T / room
    return Profile(edges, solid, envelope, _means(where, edges, pairs))


def _means(where: Floats, edges: Floats, pairs: Ints) -> Floats:
    """Return the mean coordination number of the grains in each bin."""
    touching = coordination_numbers(pairs, len(where))
    there = np.isfinite(where)
    place = np.clip(np.searchsorted(edges, where[there], "right") - 1, 0, len(edges) - 2)
    number = np.bincount(place, minlength=len(edges) - 1)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.bincount(place, touching[there], len(edges) - 1) / number)
