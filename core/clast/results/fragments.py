"""Fragments: what still hangs together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def fragments(count: int, ends: NDArray[np.int64], intact: NDArray[np.bool_]) -> NDArray[np.int64]:
    """Return the fragment number of each of ``count`` particles, from 0 in order of first appearance.

    Parameters
    ----------
    count : int
    ends : (m, 2) int64
        Particles of each bond.
    intact : (m,) bool

    Examples
    --------
    >>> fragments(4, np.array([[0, 1], [2, 3]]), np.array([True, False])).tolist()
    [0, 0, 1, 2]
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    held = ends[intact]
    graph = coo_matrix((np.ones(len(held)), (held[:, 0], held[:, 1])), shape=(count, count))
    _, label = connected_components(graph, directed=False)
    _, first, inverse = np.unique(label, return_index=True, return_inverse=True)
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return np.asarray(rank[inverse], np.int64)
