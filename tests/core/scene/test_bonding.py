"""Bonds between neighbours: exactly the pairs whose gap is asked for."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.scene.bonding import bond_neighbours

GRAIN_A = Path(__file__).parents[2] / "data" / "musen" / "grain_a"


def every_gap(x: np.ndarray, r: np.ndarray) -> dict[tuple[int, int], float]:
    return {(i, j): math.dist(x[i], x[j]) - (r[i] + r[j]) for i in range(len(x)) for j in range(i + 1, len(x))}


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 2**32),
    count=st.integers(0, 25),
    low=st.floats(-1.0, 1.0),
    width=st.floats(0.0, 1.5),
)
def test_the_bonds_are_those_brute_force_finds(seed: int, count: int, low: float, width: float) -> None:
    draw = np.random.default_rng(seed)
    x, r = draw.uniform(-2, 2, (count, 3)), draw.uniform(0.1, 1.0, count)
    bonds = bond_neighbours(x, r, max_gap=low + width, min_gap=low)
    expected = [pair for pair, gap in every_gap(x, r).items() if low <= gap <= low + width]
    assert [tuple(ends) for ends in bonds.ends.tolist()] == expected


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32), diameter=st.one_of(st.none(), st.floats(0.01, 5.0)))
def test_a_bond_is_never_thicker_than_its_smaller_particle(seed: int, diameter: float | None) -> None:
    draw = np.random.default_rng(seed)
    x, r = draw.uniform(-1, 1, (12, 3)), draw.uniform(0.1, 1.0, 12)
    bonds = bond_neighbours(x, r, max_gap=1.0, diameter=diameter)
    smaller = 2 * r[bonds.ends].min(axis=1)
    np.testing.assert_array_equal(bonds.diameter, smaller if diameter is None else np.minimum(smaller, diameter))
    assert np.isnan(bonds.length).all()


def test_both_bounds_of_the_gap_are_included_to_the_bit() -> None:
    x = np.array([[0.0, 0.0, 0.0], [2.5, 0.0, 0.0], [5.25, 0.0, 0.0]])
    bonds = bond_neighbours(x, np.ones(3), max_gap=0.75, min_gap=0.5)
    assert bonds.ends.tolist() == [[0, 1], [1, 2]]


def test_the_reference_grain_gets_the_bonds_of_its_file() -> None:
    with (GRAIN_A / "particles.csv").open() as file:
        rows = [list(map(float, row)) for row in list(csv.reader(file))[1:]]
    with (GRAIN_A / "bonds.csv").open() as file:
        expected = {frozenset(map(int, row[:2])) for row in list(csv.reader(file))[1:]}
    table = np.array(rows)
    bonds = bond_neighbours(table[:, 1:4], table[:, 4], max_gap=0.125e-3)
    assert {frozenset(ends) for ends in bonds.ends.tolist()} == expected
    assert len(bonds.ends) == 2154


def test_no_particles_and_no_neighbours_give_no_bonds() -> None:
    assert bond_neighbours(np.zeros((0, 3)), np.zeros(0), 1.0).ends.shape == (0, 2)
    assert bond_neighbours(np.zeros((1, 3)), np.ones(1), 1.0).ends.shape == (0, 2)
    assert bond_neighbours(np.array([[0.0, 0, 0], [9, 0, 0]]), np.ones(2), 1.0).ends.shape == (0, 2)


def test_senseless_bounds_are_refused() -> None:
    with pytest.raises(ValueError, match="is above the largest"):
        bond_neighbours(np.zeros((2, 3)), np.ones(2), max_gap=0.0, min_gap=1.0)
    with pytest.raises(ValueError, match="must be above zero"):
        bond_neighbours(np.zeros((2, 3)), np.ones(2), max_gap=0.0, diameter=0.0)
