"""Starter: a neighbour search by a k-d tree."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast import hookimpl
from clast.parts.neighbour_search import NeighbourSearch
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """All pairs within twice the largest reach, found in a k-d tree and sifted.

    Limits
    ------
    Slow where sizes differ much: the largest reach counts for all.

    Source
    ------
    Maneewongvatana and Mount (1999), as in scipy.
    """


def find_pairs(position: NDArray[np.float64], reach: NDArray[np.float64]) -> NDArray[np.uint32]:
    """Return all pairs (p, 2) nearer than the sum of their reaches, the smaller number first, in rising order."""
    from scipy.spatial import cKDTree

    if len(position) < 2:
        return np.zeros((0, 2), np.uint32)
    pairs = cKDTree(position).query_pairs(2.0 * float(reach.max()) * (1.0 + 1e-9), output_type="ndarray")
    i, j = pairs.min(axis=1), pairs.max(axis=1)
    d, far = position[i] - position[j], reach[i] + reach[j]
    near = d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1] + d[:, 2] * d[:, 2] < far * far
    i, j = i[near], j[near]
    order = np.lexsort((j, i))
    return np.column_stack([i[order], j[order]]).astype(np.uint32)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the search."""
    registry.neighbour_search("starter", NeighbourSearch("a k-d tree", Starter, find_pairs))
