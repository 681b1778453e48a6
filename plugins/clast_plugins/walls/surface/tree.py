"""A tree of boxes around triangles, laid out so that it is walked without a stack: C. Ericson (2005), Sect. 6.6.2."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

LEAF = 4
"""Most triangles of a box that is not parted any more."""


class Tree(NamedTuple):
    """Boxes in the order in which they are walked: each is followed by what it holds.

    Attributes
    ----------
    order : (t,) int64
        Triangles in the order of the boxes that hold them.
    boxes : (n, 6) float64
        Corners with the smallest and with the largest coordinates.
    links : (n, 3) float64
        Where to go on for what does not reach a box, and from which to which triangle it holds by itself.
    """

    order: NDArray[np.int64]
    boxes: NDArray[np.float64]
    links: NDArray[np.float64]


def planted(triangles: NDArray[np.float64]) -> Tree:
    """Return the tree of triangles, (t, 3, 3): each box is parted amid its triangles, along its longest side."""
    lower, upper = triangles.min(axis=1), triangles.max(axis=1)
    middle = 0.5 * (lower + upper)
    order: list[NDArray[np.int64]] = []
    boxes: list[NDArray[np.float64]] = []
    links: list[list[int]] = []
    # what is still to do: the triangles of a box, or the number of one whose contents are done
    waiting: list[NDArray[np.int64] | int] = [np.arange(len(triangles))]
    placed = 0
    while waiting:
        mine = waiting.pop()
        if isinstance(mine, int):
            links[mine][0] = len(links)
            continue
        waiting.append(len(links))
        boxes.append(np.concatenate([lower[mine].min(axis=0), upper[mine].max(axis=0)]))
        if len(mine) <= LEAF:
            order.append(mine)
            links.append([0, placed, placed + len(mine)])
            placed += len(mine)
            continue
        links.append([0, 0, 0])
        axis = int(np.argmax(np.ptp(middle[mine], axis=0)))
        ranked = mine[np.argsort(middle[mine, axis], kind="stable")]
        half = len(ranked) // 2
        waiting += [ranked[half:], ranked[:half]]
    return Tree(np.concatenate(order), np.array(boxes), np.array(links, float))
