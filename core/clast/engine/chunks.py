"""Chunks: the runs of particles that one thread handles at a time, cut by the scene and never by the thread count.

Whatever joins two chunks (a bond, a contact) is kept by both and loads its own end in each: the same arithmetic on the
same numbers, so both copies stay the same to the bit, and no sum of loads crosses threads.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.engine.kernels.layout import FIRST, SECOND
from clast.engine.state import Bytes, Indices, Integers

SIZE = 2048
"""Particles a chunk: their tables and a share of the bonds' stay in a core's second-level cache."""

LARGE = 2 * SIZE
"""Scenes up to this many particles are one chunk: sharing their steps costs more than it brings."""


def cut(count: int, ends: Integers) -> Indices:
    """Return where chunks begin and end: (c + 1,) particle numbers.

    Each cut lies within a quarter of the size around its place, where the fewest bonds cross: between grains, if any
    two meet there.

    Parameters
    ----------
    count : int
        Number of particles.
    ends : (m, 2) int64
        Particles of every bond.

    >>> cut(10, np.zeros((0, 2), np.int64)).tolist()
    [0, 10]
    """
    if count <= LARGE:
        return np.array([0, count], np.uint32)
    starts = np.bincount(ends.min(axis=1, initial=count) + 1, minlength=count + 2)[: count + 1]
    stops = np.bincount(ends.max(axis=1, initial=0) + 1, minlength=count + 2)[: count + 1]
    crossing = np.cumsum(starts - stops)  # bonds between particles below k and from k on
    cuts = [0]
    while count - cuts[-1] > LARGE:
        place = cuts[-1] + SIZE
        near = np.arange(place - SIZE // 4, place + SIZE // 4)
        cuts.append(int(near[np.lexsort((np.abs(near - place), crossing[near]))[0]]))
    return np.array([*cuts, count], np.uint32)


def home_of(chunks: Indices, particles: NDArray[Any]) -> Integers:
    """Return the chunk of each particle.

    >>> home_of(np.array([0, 3, 5], np.uint32), np.array([0, 2, 3, 4])).tolist()
    [0, 0, 1, 1]
    """
    return np.asarray(np.searchsorted(chunks, particles, side="right") - 1)


def shared_out(chunks: Indices, ends: Integers) -> tuple[Integers, Bytes, Indices]:
    """Return which rows every chunk keeps, in their order.

    Parameters
    ----------
    chunks : (c + 1,) uint32
    ends : (m, 2) int64
        Particles that each row joins.

    Returns
    -------
    rows : (k,) int64
        Row numbers, chunk after chunk; a row that joins two chunks appears in both.
    sides : (k,) uint8
        Which ends the chunk loads: FIRST, SECOND, or both.
    begin : (c + 1,) uint32
        Where each chunk's rows begin.
    """
    home = home_of(chunks, ends)
    crosses = np.nonzero(home[:, 0] != home[:, 1])[0]
    rows = np.concatenate([np.arange(len(ends)), crosses])
    chunk = np.concatenate([home[:, 0], home[crosses, 1]])
    sides = np.full(len(rows), FIRST | SECOND, np.uint8)
    sides[crosses] = FIRST
    sides[len(ends) :] = SECOND
    order = np.argsort(chunk * len(rows) + rows, kind="stable")  # most are in order, which this sort makes use of
    begin = np.searchsorted(chunk[order], np.arange(len(chunks)))
    return rows[order], sides[order], begin.astype(np.uint32)
