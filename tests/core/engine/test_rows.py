"""Half a row at a time gives the bits that number by number gives."""

from __future__ import annotations

import numpy as np
from numba import njit

from clast.engine.compiler import STRICT
from clast.engine.kernels.rows import add_to_row, set_first_half, set_half_row, set_row, take_from_row

RANDOM = np.random.default_rng(5)


@njit(**STRICT)
def sums(table, rows, vectors, wanted):
    for k in range(len(rows)):
        x, y, z = vectors[k]
        add_to_row(table, rows[k], 0, (x, y, z), wanted[k])
        take_from_row(table, rows[k], 4, (z, x, y), wanted[k])


@njit(**STRICT)
def moved(table, base, source, row, factor):
    set_row(table, row, base, factor, source)
    set_first_half(table, row + 1, base, factor, source)
    set_half_row(table, row + 2, 4, factor, source)


def test_vectors_are_added_and_taken_where_they_are_wanted():
    table, vectors = RANDOM.normal(size=(5, 8)), RANDOM.normal(size=(40, 3))
    rows, wanted = RANDOM.integers(0, 5, 40).astype(np.uint32), RANDOM.random(40) < 0.7
    expected = table.copy()
    for row, (x, y, z), yes in zip(rows, vectors, wanted, strict=True):
        if yes:
            expected[row, :3] += (x, y, z)
            expected[row, 4:7] -= (z, x, y)
    sums(table, rows, vectors, wanted)
    assert 0 < wanted.sum() < 40
    assert table.tobytes() == expected.tobytes()


def test_rows_are_set_to_sums_of_others_with_two_roundings():
    table, base, source = RANDOM.normal(size=(3, 6, 8))
    expected, factor = table.copy(), 0.1
    expected[2] = base[2] + factor * source[2]
    expected[3, :4] = base[3, :4] + factor * source[3, :4]
    expected[4, 4:] = factor * source[4, 4:]
    moved(table, base, source, 2, factor)
    assert table.tobytes() == expected.tobytes()
