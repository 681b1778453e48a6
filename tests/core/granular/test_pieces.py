"""Pieces are what a union-find of the intact bonds gives, and no mass or envelope gets lost among them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from clast.granular.damage import CRUSHED, DAMAGED, INTACT, damage, grain_results
from clast.granular.grading import grading
from clast.granular.grains import Grains
from clast.granular.pieces import pieces
from clast.results.fragments import fragments

SIZE = 7


def bed(count: int, seed: int) -> tuple[Grains, NDArray[np.int64]]:
    """Return grains of seven primaries in random order, and bonds between random primaries of one grain."""
    dice = np.random.default_rng(seed)
    grain = dice.permutation(np.repeat(np.arange(count), SIZE))
    volume = dice.uniform(1.0, 2.0, count * SIZE)
    of_grain = np.bincount(grain, volume)
    grains = Grains(
        of_primary=grain,
        primaries=np.bincount(grain),
        primary_volume=volume,
        primary_mass=3.0 * volume,
        volume=of_grain,
        mass=3.0 * of_grain,
        envelope=of_grain * dice.uniform(1.2, 2.0, count),
    )
    members = np.argsort(grain, kind="stable").reshape(count, SIZE)
    pairs = np.array([(a, b) for a in range(SIZE) for b in range(a)])
    ends = members[:, pairs].reshape(-1, 2)
    return grains, ends[dice.random(len(ends)) < 0.6]


def roots(count: int, ends: NDArray[np.int64]) -> list[int]:
    """Return the smallest member of the set that each of ``count`` is in, by union-find."""
    parent = list(range(count))

    def find(k: int) -> int:
        while parent[k] != k:
            k = parent[k]
        return k

    for i, j in ends.tolist():
        a, b = find(i), find(j)
        parent[max(a, b)] = min(a, b)
    return [find(k) for k in range(count)]


@given(st.integers(1, 6), st.integers(0, 10_000), st.floats(0.0, 1.0))
def test_pieces_are_those_of_a_union_find_and_share_mass_and_envelopes(count: int, seed: int, held: float) -> None:
    grains, ends = bed(count, seed)
    intact = np.random.default_rng(seed + 1).random(len(ends)) < held
    label = fragments(len(grains.of_primary), ends, intact)
    found = pieces(grains, label, np.ones(len(label), bool))
    expected = roots(len(label), ends[intact])
    assert len(set(expected)) == found.count
    assert len(set(zip(expected, found.of_primary.tolist(), strict=True))) == found.count
    assert found.mass.sum() == pytest.approx(grains.mass.sum(), rel=1e-12)
    assert np.bincount(found.grain, found.volume) == pytest.approx(grains.volume)
    single = found.primaries == 1
    assert found.envelope[single] == pytest.approx(found.volume[single], rel=1e-12)
    assert found.volume[~single] / found.envelope[~single] == pytest.approx(1.0 - grains.porosity[found.grain[~single]])
    assert grading(found.envelope_diameter, found.mass).share.sum() == pytest.approx(1.0, rel=1e-12)


@given(st.integers(1, 6), st.integers(0, 10_000), st.floats(0.0, 1.0))
def test_damage_counts_every_bond_once_and_the_largest_fragment_decides(count: int, seed: int, held: float) -> None:
    grains, ends = bed(count, seed)
    broken = np.random.default_rng(seed + 1).random(len(ends)) >= held
    label = fragments(len(grains.of_primary), ends, ~broken)
    told = damage(grains.of_primary, grains.primary_mass, label, ends, broken)
    assert told.bonds.sum() == len(ends)
    assert told.broken.sum() == broken.sum()
    assert (told.damage >= 0.0).all()
    assert (told.damage <= 1.0).all()
    assert sum(told.number(state) for state in (INTACT, DAMAGED, CRUSHED)) == count
    for k in range(count):
        mine = grains.of_primary == k
        pieces_of_it = np.bincount(label[mine], grains.primary_mass[mine])
        assert told.largest[k] == pytest.approx(pieces_of_it.max() / grains.mass[k])
        assert (told.state[k] == CRUSHED) == (told.largest[k] < 0.5)


def test_a_whole_grain_has_the_envelope_it_was_packed_with() -> None:
    grains, _ = bed(3, 0)
    found = pieces(grains, grains.of_primary, np.ones(21, bool))
    assert found.envelope == pytest.approx(grains.envelope)


def test_what_has_left_is_no_fragment_and_counts_as_lost_by_its_grain() -> None:
    grains, ends = bed(2, 1)
    there = grains.of_primary != 1
    found = pieces(grains, grains.of_primary, there)
    assert found.grain.tolist() == [0]
    told = damage(grains.of_primary, grains.primary_mass, found.of_primary, ends, np.zeros(len(ends), bool))
    assert told.largest.tolist() == [pytest.approx(1.0), 0.0]
    assert told.state.tolist() == [INTACT, CRUSHED]


def test_a_summary_tells_of_more_than_one_grain_only() -> None:
    grains, ends = bed(2, 1)
    broken = grains.of_primary[ends[:, 0]] == 1
    label = fragments(14, ends, ~broken)
    told = grain_results(grains.of_primary, grains.primary_mass, label, ends, broken)["grains"]
    assert told == {"intact": 1, "damaged": 0, "crushed": 1, "mean_damage": 0.5}
    assert grain_results(np.zeros(14, np.int64), grains.primary_mass, label, ends, broken) == {}
