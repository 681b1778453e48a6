"""Brute force: every pair is looked at. The oracle for all other searches."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast import hookimpl
from clast.parts.neighbour_search import NeighbourSearch
from clast.parts.params import Params
from clast.plugins.registry import Registry


class BruteForce(Params):
    """Look at all n(n−1)/2 pairs, one row at a time."""


def find_pairs(position: NDArray[np.float64], reach: NDArray[np.float64]) -> NDArray[np.uint32]:
    """Return all pairs with |x_i − x_j| < reach_i + reach_j.

    >>> find_pairs(np.array([[0.0, 0, 0], [1.0, 0, 0], [5.0, 0, 0]]), np.array([0.6, 0.6, 0.6])).tolist()
    [[0, 1]]
    """
    rows = [np.zeros((0, 2), np.uint32)]
    for i in range(len(position) - 1):
        d = position[i + 1 :] - position[i]
        s = reach[i + 1 :] + reach[i]
        distance2 = d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1] + d[:, 2] * d[:, 2]
        j = np.nonzero(distance2 < s * s)[0] + i + 1
        rows.append(np.column_stack([np.full(len(j), i), j]).astype(np.uint32))
    return np.concatenate(rows)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer brute force."""
    registry.neighbour_search(
        "brute_force",
        NeighbourSearch(summary="look at every pair", Params=BruteForce, find_pairs=find_pairs),
    )
