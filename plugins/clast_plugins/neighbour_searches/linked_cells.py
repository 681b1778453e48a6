"""Linked cells: only particles in neighbouring cells of a grid are looked at."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast import hookimpl
from clast.parts.neighbour_search import NeighbourSearch
from clast.parts.params import Params
from clast.plugins.registry import Registry


class LinkedCells(Params):
    """A grid of cells as wide as the largest pair of reaches; each particle looks into 27 of them.

    Cells are widened until there are at most about two per particle, so far-flung fragments cost no memory.

    Source: Hockney and Eastwood, "Computer Simulation Using Particles" (1981), Section 8-4.
    """


def find_pairs(position: NDArray[np.float64], reach: NDArray[np.float64]) -> NDArray[np.uint32]:
    """Return all pairs with |x_i − x_j| < reach_i + reach_j, as brute force does."""
    from clast_plugins.neighbour_searches.linked_cells_kernel import search_cells

    n = len(position)
    if n < 2:
        return np.zeros((0, 2), np.uint32)
    low = position.min(axis=0)
    extent = position.max(axis=0) - low
    # a little wider, so that rounding never puts a pair two cells apart
    width = max(2.0 * float(reach.max()) * (1.0 + 1e-6), 1e-300)
    while np.prod(np.floor(extent / width) + 1.0) > 2 * n + 64:
        width *= 1.25
    shape = (np.floor(extent / width) + 1.0).astype(np.int64)
    cell = np.minimum(((position - low) / width).astype(np.int64), shape - 1)
    flat = (cell[:, 0] * shape[1] + cell[:, 1]) * shape[2] + cell[:, 2]
    members = np.argsort(flat, kind="stable")
    begins = np.searchsorted(flat[members], np.arange(np.prod(shape) + 1))
    pairs = np.empty((16 * n, 2), np.uint32)
    while True:
        count = search_cells(position, reach, cell, shape, members, begins, pairs)
        if count <= len(pairs):
            return pairs[:count]
        pairs = np.empty((count, 2), np.uint32)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer linked cells."""
    registry.neighbour_search(
        "linked_cells",
        NeighbourSearch(
            summary="a grid of cells, work in proportion to the number of particles",
            Params=LinkedCells,
            find_pairs=find_pairs,
        ),
    )
