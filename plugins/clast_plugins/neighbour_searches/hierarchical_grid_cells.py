"""The cells of the hierarchical grid: levels of sizes, and a grid for each."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

WIDER = 1.0 + 1e-6
"""So much wider are cells than a pair that reaches farthest: rounding never puts a pair two cells apart."""


class Grid(NamedTuple):
    """The cells of one level: their origin and width in m, how many there are, and who is in which.

    ``members`` are particles ordered by cell, and in a cell by number; ``begins`` tells where each cell's begin.
    """

    low: Floats
    width: float
    shape: Integers
    members: Integers
    begins: Integers


def levels(reach: Floats) -> Integers:
    """Return the level of every particle, (n,): how often its reach is the double of the smallest.

    >>> levels(np.array([1.0, 1.9, 2.0, 100.0])).tolist()
    [0, 0, 1, 6]
    """
    _, exponent = np.frexp(reach / reach.min())
    return np.asarray(exponent, np.int64) - 1


def grid_of(position: Floats, reach: Floats, mine: Integers, most: int) -> Grid:
    """Return a grid of at most about ``most`` cells for some particles, whose cells no two of them reach across."""
    placed = position[mine]
    low = placed.min(axis=0)
    extent = placed.max(axis=0) - low
    width = max(2.0 * float(reach[mine].max()) * WIDER, 1e-300)
    while np.prod(np.floor(extent / width) + 1.0) > most:
        width *= 1.25
    shape = (np.floor(extent / width) + 1.0).astype(np.int64)
    cell = np.minimum(((placed - low) / width).astype(np.int64), shape - 1)
    flat = (cell[:, 0] * shape[1] + cell[:, 1]) * shape[2] + cell[:, 2]
    order = np.argsort(flat, kind="stable")
    return Grid(low, width, shape, mine[order], np.searchsorted(flat[order], np.arange(np.prod(shape) + 1)))
