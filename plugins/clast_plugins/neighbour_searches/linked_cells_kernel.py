"""The compiled loop of linked cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.engine.compiler import compiled, inlined


@inlined
def insert(pairs: NDArray[np.uint32], begin: int, count: int, i: int, j: int) -> None:
    """Put the pair (i, j) among the pairs of i, which begin at ``begin``, in rising order of j."""
    k = count
    while k > begin and pairs[k - 1, 1] > j:
        pairs[k, 1] = pairs[k - 1, 1]
        k -= 1
    pairs[k, 1] = j
    pairs[count, 0] = i


@compiled
def search_cells(
    position: NDArray[np.float64],
    reach: NDArray[np.float64],
    cell: NDArray[np.int64],
    shape: NDArray[np.int64],
    members: NDArray[np.int64],
    begins: NDArray[np.int64],
    pairs: NDArray[np.uint32],
) -> int:
    """Write all near pairs in rising order of both columns, and return how many there are.

    Parameters
    ----------
    position : (n, 3) float64
    reach : (n,) float64
    cell : (n, 3) int64
        Cell of each particle in a grid of ``shape`` cells.
    members, begins : int64
        Particles ordered by cell, and where each cell's begin.
    pairs : (p, 2) uint32
        As many pairs as fit; when the returned number is larger, call again with more room.
    """
    count = 0
    for i in range(len(position)):
        begin = count
        for a in range(max(cell[i, 0] - 1, 0), min(cell[i, 0] + 2, shape[0])):
            for b in range(max(cell[i, 1] - 1, 0), min(cell[i, 1] + 2, shape[1])):
                row = (a * shape[1] + b) * shape[2]
                first = begins[row + max(cell[i, 2] - 1, 0)]
                last = begins[row + min(cell[i, 2] + 2, shape[2])]
                for m in range(first, last):
                    j = members[m]
                    if j <= i:
                        continue
                    dx = position[j, 0] - position[i, 0]
                    dy = position[j, 1] - position[i, 1]
                    dz = position[j, 2] - position[i, 2]
                    s = reach[j] + reach[i]
                    if dx * dx + dy * dy + dz * dz < s * s:
                        if count < len(pairs):
                            insert(pairs, begin, count, i, j)
                        count += 1
    return count
