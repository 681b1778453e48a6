"""One and two spheres, column by column against MUSEN."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

from tests.parity.columns import BONDS, NAMES, Tracks, columns, run
from tests.parity.musen import CASES, table

WITHIN = 1e-3
"""Largest difference as a share of a column's peak."""


@pytest.fixture(scope="module")
def tracks(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Tracks]:
    """Return a function that runs a case's scene, once, and returns its tracks."""

    @cache
    def run_once(scene: str) -> Tracks:
        return run(scene, tmp_path_factory.mktemp(scene))

    return lambda name: run_once(name if name in BONDS or name == "drop_gravity" else "impacts")


@pytest.mark.parametrize("name", NAMES)
def test_every_column_of_a_case(tracks: Callable[[str], Tracks], name: str) -> None:
    """Columns that are 0 in MUSEN are exactly 0."""
    ours, theirs = columns(name, tracks(name)), table(f"micro/{name}")
    assert ours.keys() == theirs.keys()
    away = {column: np.abs(ours[column] - theirs[column]).max() for column in theirs}
    peak = {column: np.abs(theirs[column]).max() for column in theirs}
    assert {
        column: (away[column], peak[column]) for column in theirs if not away[column] <= WITHIN * peak[column]
    } == {}


@pytest.mark.parametrize("name", BONDS)
def test_a_bond_breaks_in_the_same_step(tracks: Callable[[str], Tracks], name: str) -> None:
    expected = CASES[name]["result"]["break_time_s"]
    found = tracks(name).cracks["time"]
    assert found == pytest.approx([] if expected is None else [expected], rel=1e-9)
