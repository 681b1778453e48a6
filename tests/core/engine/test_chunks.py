"""Chunks: cut where grains meet, everything kept once or on both sides, and the same bits for any number of threads."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast import load
from clast.engine import chunks
from clast.engine.chunks import cut, shared_out
from clast.engine.kernels.layout import FIRST, SECOND
from clast.engine.tables import crack_rows, failure_index, intact
from clast.simulation import Simulation
from tests.scenes import CRUSH, write


def test_a_small_scene_is_one_chunk() -> None:
    assert cut(chunks.LARGE, np.zeros((0, 2), np.int64)).tolist() == [0, chunks.LARGE]


def test_cuts_fall_between_grains() -> None:
    size, grains = 300, 40
    within = np.column_stack([np.arange(size - 1), np.arange(1, size)])
    ends = np.concatenate([within + size * g for g in range(grains)])
    cuts = cut(size * grains, ends)
    assert len(cuts) > 3
    assert all(c % size == 0 for c in cuts)
    assert np.diff(cuts.astype(int)).max() <= chunks.LARGE


joins = st.lists(st.tuples(st.integers(0, 29), st.integers(0, 29)).filter(lambda e: e[0] != e[1]), max_size=60)


@given(joins, st.sets(st.integers(1, 29), max_size=4))
def test_every_end_is_loaded_once_by_its_own_chunk(pairs: list[tuple[int, int]], inner: set[int]) -> None:
    ends = np.array(sorted(pairs), np.int64).reshape(-1, 2)
    bounds = np.array([0, *sorted(inner), 30], np.uint32)
    rows, sides, begin = shared_out(bounds, ends)
    loaded = []
    for c in range(len(bounds) - 1):
        here = slice(begin[c], begin[c + 1])
        assert (np.diff(rows[here]) > 0).all()
        for row, side in zip(rows[here], sides[here], strict=True):
            for bit, end in ((FIRST, 0), (SECOND, 1)):
                if side & bit:
                    assert bounds[c] <= ends[row, end] < bounds[c + 1]
                    loaded.append((int(row), end))
    assert sorted(loaded) == [(row, end) for row in range(len(ends)) for end in (0, 1)]


def crushed(folder: Path, threads: int) -> Simulation:
    """Return a small grain, crushed until many bonds have broken."""
    file = write(folder, CRUSH)
    simulation = Simulation(load(file, ["walls.upper.motion.velocity=[0, 0, -0.1]"]), threads)
    simulation.advance_to(8000)
    return simulation


def test_bits_depend_neither_on_threads_nor_on_chunks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = crushed(tmp_path, 1)
    monkeypatch.setattr(chunks, "SIZE", 12)
    monkeypatch.setattr(chunks, "LARGE", 18)
    alone, together = crushed(tmp_path, 1), crushed(tmp_path, 2)
    assert len(whole.world.chunks) == 2 < len(alone.world.chunks)
    assert (alone.world.bonds.sides == SECOND).any()
    assert alone.bonds_broken > 20
    for other in (together, whole):
        for name, table in alone.world.particles._asdict().items():
            np.testing.assert_array_equal(table, getattr(other.world.particles, name), err_msg=name)
        np.testing.assert_array_equal(intact(alone.world.bonds), intact(other.world.bonds))
        np.testing.assert_array_equal(failure_index(alone.world.bonds), failure_index(other.world.bonds))
        np.testing.assert_array_equal(alone.bond_loads(), other.bond_loads())
    one, two, unchunked = (s.world.cracks.bond[crack_rows(s.world.cracks)] for s in (alone, together, whole))
    np.testing.assert_array_equal(one, two)
    np.testing.assert_array_equal(np.sort(one), np.sort(unchunked))
    steps = alone.world.cracks.step[crack_rows(alone.world.cracks)]
    assert (np.diff(steps) >= 0).all()
