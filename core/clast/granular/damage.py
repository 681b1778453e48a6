"""Damage: how much of each grain is broken."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
INTACT, DAMAGED, CRUSHED = 0, 1, 2
HALF = 0.5
"""Share of its mass below which the largest fragment of a grain leaves it crushed."""


class Damage(NamedTuple):
    """What is broken of each of ``g`` grains.

    Attributes
    ----------
    bonds, broken : (g,) int64
        Bonds that a grain had, and how many of them have broken.
    damage : (g,) float64
        D = broken/bonds, from 0 to 1; 0 for a grain without bonds.
    largest : (g,) float64
        Share of a grain's mass that its largest fragment holds.
    state : (g,) int64
        0 intact: no bond broken; 2 crushed: the largest fragment is lighter than half of the grain; 1 damaged:
        neither. Intact and damaged grains are the survivors.
    """

    bonds: Ints
    broken: Ints
    damage: Floats
    largest: Floats
    state: Ints

    def number(self, state: int) -> int:
        """Return how many grains are in a state."""
        return int(np.count_nonzero(self.state == state))


def damage(grain: Ints, mass: Floats, label: Ints, ends: NDArray[np.integer], broken: NDArray[np.bool_]) -> Damage:
    """Return the damage of each grain.

    Parameters
    ----------
    grain : (n,) int64
        Grain of each primary; −1 for none.
    mass : (n,) float64
        Of each primary, in any unit.
    label : (n,) int64
        Fragment of each primary, from 0; −1 for those that have left, which count as lost by their grain.
    ends : (m, 2) int
        Primaries of each bond; a bond counts for the grain of its first one.
    broken : (m,) bool

    Examples
    --------
    Two grains of four and two primaries; the first has lost one primary and both bonds of it:

    >>> ends = np.array([[0, 1], [1, 2], [2, 3], [1, 3], [4, 5]])
    >>> lost = np.array([False, False, True, True, False])
    >>> told = damage(np.array([0, 0, 0, 0, 1, 1]), np.ones(6), np.array([0, 0, 0, 1, 2, 2]), ends, lost)
    >>> told.damage.tolist(), told.largest.tolist(), told.state.tolist()
    ([0.5, 0.0], [0.75, 1.0], [1, 0])
    """
    count = int(grain.max(initial=-1)) + 1
    owner = grain[ends[:, 0]]
    bonds = np.bincount(owner[owner >= 0], minlength=count)
    gone = np.bincount(owner[broken & (owner >= 0)], minlength=count)
    largest = _largest(grain, mass, label, count)
    state = np.where(largest < HALF, CRUSHED, np.where(gone > 0, DAMAGED, INTACT))
    return Damage(bonds, gone, gone / np.maximum(bonds, 1), largest, state)


def grain_results(
    grain: Ints, mass: Floats, label: Ints, ends: NDArray[np.integer], broken: NDArray[np.bool_]
) -> dict[str, Any]:
    """Return what a summary tells of more than one grain; arguments as :func:`damage`."""
    if grain.max(initial=-1) < 1:
        return {}
    found = damage(grain, mass, label, ends, broken)
    return {
        "grains": {
            "intact": found.number(INTACT),
            "damaged": found.number(DAMAGED),
            "crushed": found.number(CRUSHED),
            "mean_damage": float(found.damage.mean()),
        }
    }


def _largest(grain: Ints, mass: Floats, label: Ints, count: int) -> Floats:
    inside = grain >= 0
    whole = np.bincount(grain[inside], mass[inside], count)
    held = inside & (label >= 0)
    pair, inverse = np.unique(grain[held] * (label.max(initial=0) + 1) + label[held], return_inverse=True)
    largest = np.zeros(count)
    np.maximum.at(largest, pair // (label.max(initial=0) + 1), np.bincount(inverse, mass[held], len(pair)))
    return largest / np.maximum(whole, np.finfo(float).tiny)
