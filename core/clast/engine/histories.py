"""Histories: what contacts remember, and where their bonds are, as lists of neighbours are made anew."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.engine.cache_lines import APART, on_lines, room_on_line
from clast.engine.chunks import shared_out
from clast.engine.kernels.layout import FIRST, INTACT, LANES
from clast.engine.state import Bonds, Indices, Integers, Pairs
from clast.engine.tables import slot_view

ROOM, ROOM_SHARE = 32, 16
"""Rows of room in each chunk, and how many rows get one more."""


def pair_rows(found: Integers, chunks: Indices, bonds: Bonds, old: Pairs, known: Integers) -> Pairs:
    """Return the rows of pairs, with the history of those that are known.

    Parameters
    ----------
    found : (p, 2) int64
        Pairs i < j in rising order.
    chunks : (c + 1,) uint32
        Particle numbers where chunks begin.
    bonds, old : tables
    known : (k,) int64
        Rows of the old table that may be among them, in rising order.
    """
    rows, sides, begin = shared_out(chunks, found)
    found = found[rows]
    known = known[_telling(old, known)]
    before, now = key(old.first[known], old.second[known]), key(found[:, 0], found[:, 1])
    touching, history, rest = carried(before, now, old.touching[known], old.history[known], old.rest[known])
    first, second = (np.ascontiguousarray(end, np.uint32) for end in found.T)
    return Pairs(first, second, sides, bond_places(bonds, found, begin), rest, touching, history, begin, begin[1:])


def _telling(old: Pairs, known: Integers) -> NDArray[np.bool_]:
    """Tell which rows have something to remember; both rows of a pair that joins two chunks remember the same."""
    held = (old.touching[known] != 0) | (old.rest[known] != 0.0)
    return np.asarray(held & (old.sides[known] & FIRST != 0))


def with_room(rows: Pairs) -> Pairs:
    """Return rows of pairs on cache lines, with room behind those of each chunk for pairs that are found later.

    A scene of one chunk gets none: to search all its neighbours takes no longer than to put some in.
    """
    counts = np.diff(rows.begin).astype(np.int64)
    if len(counts) == 1:
        return on_lines(rows)
    room = counts + counts // ROOM_SHARE + ROOM
    begin = np.concatenate([[0], np.cumsum(room)])
    tables = [
        room_on_line((begin[-1], *table.shape[1:]), table.dtype, k * APART) for k, table in enumerate(rows.tables)
    ]
    for first, last, begun, end, count in zip(begin[:-1], begin[1:], rows.begin[:-1], rows.end, counts, strict=True):
        for table, values in zip(tables, rows.tables, strict=True):
            table[first : first + count] = values[begun:end]
            table[first + count : last] = 0
    return Pairs._make([*tables, begin.astype(np.uint32), (begin[:-1] + counts).astype(np.uint32)])


def key(first: NDArray[Any], second: NDArray[Any]) -> Integers:
    """Return one rising number for each pair."""
    return first.astype(np.int64) << 32 | second.astype(np.int64)


def carried(old_key: Integers, new_key: Integers, *old: NDArray[Any]) -> list[NDArray[Any]]:
    """Return tables for the new pairs, with the rows of those that were known; the old keys rise."""
    new = [np.zeros((len(new_key), *table.shape[1:]), table.dtype) for table in old]
    if len(old_key) > 0:
        at = np.minimum(np.searchsorted(old_key, new_key), len(old_key) - 1)
        known = old_key[at] == new_key
        for table, before in zip(new, old, strict=True):
            table[known] = before[at[known]]
    return new


def bond_places(bonds: Bonds, pairs: Integers, begin: Indices) -> Integers:
    """Return where each pair's bond stands in its chunk's part of the bond table, −1 for pairs without one."""
    return np.concatenate(
        [_places(bonds, slice(*bonds.begin[c : c + 2]), pairs[slice(*begin[c : c + 2])]) for c in range(len(begin) - 1)]
    )


def _places(bonds: Bonds, blocks: slice, pairs: Integers) -> Integers:
    place = np.full(len(pairs), -1, np.int64)
    if len(pairs) == 0:
        return place
    holds = slot_view(bonds, INTACT)[blocks] == 1.0
    standing = int(blocks.start) * LANES + np.nonzero(holds.ravel())[0]
    if len(standing) == 0:
        return place
    i, j = bonds.first.ravel()[standing], bonds.second.ravel()[standing]
    bond_key = key(np.minimum(i, j), np.maximum(i, j))
    order = np.argsort(bond_key, kind="stable")
    wanted = key(pairs[:, 0], pairs[:, 1])
    at = np.minimum(np.searchsorted(bond_key[order], wanted), len(order) - 1)
    known = bond_key[order][at] == wanted
    place[known] = standing[order[at[known]]]
    return place
