"""The compiled loop of the hierarchical grid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.engine.compiler import compiled
from clast_plugins.neighbour_searches.hierarchical_grid_cells import Grid


@compiled
def search_grids(
    position: NDArray[np.float64],
    reach: NDArray[np.float64],
    seekers: NDArray[np.int64],
    same: bool,
    grid: Grid,
    keys: NDArray[np.int64],
) -> int:
    """Write a number for every near pair of a seeker and a member of a grid, i · 2³² + j with i < j; return how many.

    Parameters
    ----------
    position : (n, 3) float64
    reach : (n,) float64
    seekers : int64
        Particles that look for others; none reaches farther than the members of the grid.
    same : bool
        Whether the seekers are the members, so that every pair would be met twice.
    grid : Grid
    keys : int64
        As many as fit are written; when the returned number is larger, call again with more room.
    """
    count, shape = 0, grid.shape
    for i in seekers:
        a0 = int(np.floor((position[i, 0] - grid.low[0]) / grid.width))
        b0 = int(np.floor((position[i, 1] - grid.low[1]) / grid.width))
        c0 = int(np.floor((position[i, 2] - grid.low[2]) / grid.width))
        if c0 < -1 or c0 > shape[2]:
            continue
        for a in range(max(a0 - 1, 0), min(a0 + 2, shape[0])):
            for b in range(max(b0 - 1, 0), min(b0 + 2, shape[1])):
                row = (a * shape[1] + b) * shape[2]
                first = grid.begins[row + max(c0 - 1, 0)]
                last = grid.begins[row + min(c0 + 2, shape[2])]
                for m in range(first, last):
                    j = grid.members[m]
                    if j == i or (same and j < i):
                        continue
                    dx = position[j, 0] - position[i, 0]
                    dy = position[j, 1] - position[i, 1]
                    dz = position[j, 2] - position[i, 2]
                    s = reach[j] + reach[i]
                    if dx * dx + dy * dy + dz * dz < s * s:
                        if count < len(keys):
                            keys[count] = (min(i, j) << 32) | max(i, j)
                        count += 1
    return count
