"""Near pairs: what a neighbour search finds, across the faces of a periodic box too.

Searches know nothing of boxes. Particles near the lower face of a periodic direction are shown to them a second time,
beyond the upper one; what comes back names the particles themselves.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.maths.box import Box
from clast.parts.neighbour_search import NeighbourSearch

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

ROUNDING = 1e-9
"""Share by which the layer of repeated particles is thicker than what can be reached: places are rounded."""


def near_pairs(search: NeighbourSearch, position: Floats, reach: Floats, box: Box) -> Integers:
    """Return all pairs of particles whose nearest images are nearer than the sum of their reaches.

    Parameters
    ----------
    search : NeighbourSearch
    position : (n, 3) float64
        In m, anywhere.
    reach : (n,) float64
        In m; a side of the box that repeats must be longer than four of the largest.
    box : Box

    Returns
    -------
    pairs : (p, 2) int64
        With i < j, in rising order.
    """
    if not box.repeats:
        return np.asarray(search.find_pairs(position, reach), np.int64).reshape(-1, 2)
    seen, which = with_images(box.wrapped(position), 2.0 * float(reach.max(initial=0.0)), box)
    found = search.find_pairs(np.ascontiguousarray(seen), reach[which]).astype(np.int64)
    pairs = np.sort(which[found].reshape(-1, 2), axis=1)
    return np.asarray(np.unique(pairs, axis=0))


def with_images(position: Floats, far: float, box: Box) -> tuple[Floats, Integers]:
    """Return positions within a box and behind them images of those near its lower faces; and whose each is.

    One layer is enough: two particles that meet across an upper face meet there. What is near several faces gets an
    image beyond each of them and beyond their edges; pairs across an edge may then be those of two images.

    Parameters
    ----------
    position : (n, 3) float64
        In m, within the box in directions that repeat.
    far : float
        How far apart two particles may be at the most that count as near, in m.
    box : Box

    Returns
    -------
    position : (n + k, 3) float64
    particle : (n + k,) int64

    Examples
    --------
    >>> box = Box(np.zeros(3), np.full(3, 10.0), np.array([True, True, False]))
    >>> seen, which = with_images(np.array([[1.0, 1.0, 1.0], [1.0, 9.0, 1.0]]), 2.0, box)
    >>> which.tolist(), seen[2:].tolist()
    ([0, 1, 0, 1, 0, 0], [[11.0, 1.0, 1.0], [11.0, 9.0, 1.0], [1.0, 11.0, 1.0], [11.0, 11.0, 1.0]])
    """
    particle = np.arange(len(position))
    for axis in np.flatnonzero(box.periodic):
        near = np.flatnonzero(position[:, axis] - box.lower[axis] <= far * (1.0 + ROUNDING))
        images = position[near]
        images[:, axis] += box.span[axis]
        position, particle = np.concatenate([position, images]), np.concatenate([particle, particle[near]])
    return position, particle
