"""Pieces of grains: what still hangs together by bonds in a frame, how heavy and how large it is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from clast.granular.grains import Grains, sums
from clast.results.fragments import fragments
from clast.results.frame import Frame
from clast.results.run import Run

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Pieces:
    """Fragments of grains in one frame. ``n`` primaries, ``f`` fragments.

    Attributes
    ----------
    of_primary : (n,) int64
        Fragment of each primary, from 0; −1 for particles that have left or belong to no grain.
    grain, primaries : (f,) int64
        The grain a fragment comes from, and how many primaries it has.
    volume, mass : (f,) float64
        Of its primaries, in m³ and kg.
    envelope : (f,) float64
        Its volume with pores in m³: the solid volume over 1 − p with the porosity p of its grain as packed; of a single
        primary, which has no pores, its own volume.
    """

    of_primary: Ints
    grain: Ints
    primaries: Ints
    volume: Floats
    mass: Floats
    envelope: Floats

    @property
    def count(self) -> int:
        """How many fragments there are."""
        return len(self.primaries)

    @cached_property
    def diameter(self) -> Floats:
        """Diameter of the sphere with the solid volume of each fragment in m, (f,)."""
        return np.cbrt(6.0 / np.pi * self.volume)

    @cached_property
    def envelope_diameter(self) -> Floats:
        """Diameter of the sphere with the envelope volume of each fragment in m, (f,): the size that a sieve sees."""
        return np.cbrt(6.0 / np.pi * self.envelope)


def pieces_in(run: Run, grains: Grains, frame: Frame) -> Pieces:
    """Return the fragments of the grains of a run in a frame."""
    label = fragments(len(run.radius), run.bond_ends.astype(np.int64), frame.bond_intact)
    return pieces(grains, label, np.isfinite(frame.position[:, 0]))


def pieces(grains: Grains, label: Ints, present: NDArray[np.bool_]) -> Pieces:
    """Return fragments from the number of the fragment that each primary is in.

    Parameters
    ----------
    grains : Grains
    label : (n,) int64
        Any numbers that tell fragments apart.
    present : (n,) bool
        Which particles have not left.
    """
    counted = present & (grains.of_primary >= 0)
    numbers, first, inverse = np.unique(label[counted], return_index=True, return_inverse=True)
    of_primary = np.full(len(label), -1, np.int64)
    of_primary[counted] = inverse
    grain = grains.of_primary[counted][first]
    primaries = np.bincount(inverse, minlength=len(numbers))
    volume = sums(inverse, grains.primary_volume[counted], len(numbers))
    porous = np.where(primaries > 1, np.nan_to_num(grains.porosity)[grain], 0.0)
    return Pieces(
        of_primary=of_primary,
        grain=grain,
        primaries=primaries,
        volume=volume,
        mass=sums(inverse, grains.primary_mass[counted], len(numbers)),
        envelope=volume / (1.0 - porous),
    )
