"""The compiled loop of linked cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.engine.compiler import compiled


@compiled
def count_or_fill(
    position: NDArray[np.float64],
    reach: NDArray[np.float64],
    cell: NDArray[np.int64],
    shape: NDArray[np.int64],
    members: NDArray[np.int64],
    begins: NDArray[np.int64],
    counts: NDArray[np.int64],
    pairs: NDArray[np.uint32],
) -> None:
    """Count each particle's later neighbours into ``counts[i + 1]``, or write them from ``counts[i]`` on.

    Parameters
    ----------
    position : (n, 3) float64
    reach : (n,) float64
    cell : (n, 3) int64
        Cell of each particle in a grid of ``shape`` cells.
    members, begins : int64
        Particles ordered by cell, and where each cell's begin.
    counts : (n + 1,) int64
        Filled when ``pairs`` is empty, else read as offsets.
    pairs : (p, 2) uint32
        Written in rising order of both columns.
    """
    fill = len(pairs) > 0
    for i in range(len(position)):
        at = begin = counts[i] if fill else 0
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
                        if fill:
                            k = at
                            while k > begin and pairs[k - 1, 1] > j:
                                pairs[k, 1] = pairs[k - 1, 1]
                                k -= 1
                            pairs[k, 0] = i
                            pairs[k, 1] = j
                            pairs[at, 0] = i
                        at += 1
        if not fill:
            counts[i + 1] = at
