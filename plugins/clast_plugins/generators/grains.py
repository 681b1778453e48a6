"""Which particles hang together: grains are what bonds connect."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]


def connected_grains(count: int, ends: Ints) -> Ints:
    """Return the number of the bonded group each particle is in, counted in the order of first particles.

    Parameters
    ----------
    count : int
        Number of particles.
    ends : (m, 2) int64
        Particle indices of each bond.

    Returns
    -------
    (count,) int64
        Grain of each particle, from 0; -1 for particles without a bond.

    Examples
    --------
    >>> connected_grains(5, np.array([[1, 3], [4, 3]])).tolist()
    [-1, 0, -1, 0, 0]
    """
    grain = np.full(count, -1, np.int64)
    if not len(ends):
        return grain
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    links = coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(count, count))
    _, label = connected_components(links, directed=False)
    bonded = np.unique(ends)
    _, first, group = np.unique(label[bonded], return_index=True, return_inverse=True)
    grain[bonded] = np.argsort(np.argsort(first))[group]
    return grain
