"""Each check gives each verdict where it should; statistics are those of the textbook."""

from __future__ import annotations

from dataclasses import replace
from math import isinf
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from clast.studies.axis import Setting
from clast.studies.expectation_config import Expectation
from clast.studies.measures import Curve
from clast.studies.statistics import statistic
from clast.studies.table import Row, Table
from clast.studies.tasks import Task
from clast.studies.verdict import NOT_REPRODUCED, OPEN, REPRODUCED, judge

STRAIN = np.linspace(0.0, 0.2, 50)


def table(mean: Any, scatter: float, repeats: int = 4, points: tuple[float, ...] = (1.0, 2.0, 3.0, 4.0)) -> Table:
    """Return runs whose measure is a function of x, with some scatter; curves are straight lines of that slope."""
    random = np.random.default_rng(2)
    rows = []
    for k, x in enumerate(points):
        for repeat in range(repeats):
            y = float(mean(x) + scatter * random.normal())
            task = Task(f"{x}-{repeat}", "", k, repeat, (Setting("x", str(x), x, {}),), "")
            curve = Curve(STRAIN, y * STRAIN, y * STRAIN, 0.0 * STRAIN, 1)
            rows.append(Row(task, "done", "", {"m": y}, curve))
    return Table(rows)


def verdict(found: Table, **keys: Any) -> str:
    """Return what one statement is judged to be."""
    return judge(found, [Expectation.model_validate({"says": "so", **keys})])[0].verdict


@pytest.mark.parametrize(
    ("mean", "scatter", "expected"),
    [
        (lambda x: x, 0.2, REPRODUCED),
        (lambda x: -x, 0.2, NOT_REPRODUCED),
        (lambda x: 5.0, 0.2, OPEN),
        (lambda x: x if x < 4 else 1.0, 0.1, NOT_REPRODUCED),  # turned round at the end
    ],
)
def test_growth(mean: Any, scatter: float, expected: str) -> None:
    assert verdict(table(mean, scatter), check="grows", measure="m") == expected


def test_a_measure_that_is_the_same_everywhere_has_no_trend() -> None:
    assert verdict(table(lambda x: 5.0, 0.0), check="grows", measure="m") == OPEN
    assert verdict(table(lambda x: 5.0, 0.0), check="same", measure="m") == REPRODUCED


def test_a_fall_is_growth_upside_down() -> None:
    assert verdict(table(lambda x: -x, 0.2), check="falls", measure="m") == REPRODUCED
    assert verdict(table(lambda x: x, 0.2), check="falls", measure="m") == NOT_REPRODUCED


@pytest.mark.parametrize("measure", ["m", "curves"])
def test_no_influence(measure: str) -> None:
    same = {"check": "same", "measure": measure, "within": 0.1}
    assert verdict(table(lambda x: 5.0, 0.2), **same) == REPRODUCED
    assert verdict(table(lambda x: 5.0 + x, 0.2), **same) == NOT_REPRODUCED
    assert verdict(table(lambda x: 5.0, 4.0, repeats=2), **same) == OPEN
    assert verdict(table(lambda x: 5.0 + 0.02 * x, 0.001), **same) == REPRODUCED  # found, but below the margin


def bent(strain: NDArray[np.float64], x: float) -> NDArray[np.float64]:
    """Return a curve that is the same for every x up to 10 % strain."""
    return strain + x * np.maximum(strain - 0.1, 0.0)


def test_curves_are_compared_as_far_as_asked() -> None:
    rows = []
    for row in table(lambda x: x, 0.0, repeats=6, points=(1.0, 2.0)).rows:
        assert row.curve is not None
        rows.append(replace(row, curve=row.curve._replace(stress=bent(STRAIN, row.task.point))))
    same = {"check": "same", "measure": "curves", "within": 0.01}
    assert verdict(Table(rows), **same) == NOT_REPRODUCED
    assert verdict(Table(rows), **same, up_to=0.3) == NOT_REPRODUCED  # no curve goes so far
    assert verdict(Table(rows), **same, up_to=0.1) == REPRODUCED
    assert verdict(Table(rows), **same, up_to=0.12) == NOT_REPRODUCED
    assert "12 runs, cut at 10 % strain" in evidence(Table(rows), **same, up_to=0.1)


def test_points_are_compared_within_repeats_which_share_their_seeds() -> None:
    """Large differences between repeats do not hide a small one between points."""
    rows = []
    for k, x in enumerate((1.0, 2.0)):
        for repeat in range(6):
            task = Task(f"{x}-{repeat}", "", k, repeat, (Setting("x", str(x), x, {}),), "")
            rows.append(Row(task, "done", "", {"m": 10.0 * (repeat + 1) + 8.0 * x}))
    assert verdict(Table(rows), check="same", measure="m", within=0.05) == NOT_REPRODUCED


def test_two_points_of_the_same_repeats_are_compared_in_pairs() -> None:
    """What all repeats have in common is no scatter; a repeat that is missing leaves both samples as they are."""
    rows = []
    for k, x in enumerate((1.0, 2.0)):
        for repeat, noise in enumerate((0.0, 0.03, -0.03)):
            task = Task(f"{x}-{repeat}", "", k, repeat, (Setting("x", str(x), x, {}),), "")
            rows.append(Row(task, "done", "", {"m": 10.0 * (repeat + 1) + x + noise * x}))
    where = {"where": {"x": 2.0}, "than": {"x": 1.0}, "measure": "m"}
    assert verdict(Table(rows), check="larger", **where) == REPRODUCED
    assert verdict(Table(rows), check="smaller", **where) == NOT_REPRODUCED
    assert verdict(Table(rows[:-1]), check="larger", **where) == OPEN
    assert "differences in pairs 1 ± 0.03 (3 runs)" in evidence(Table(rows), check="larger", **where)


def test_a_value() -> None:
    near = {"check": "equals", "measure": "m", "within": 0.1}
    assert verdict(table(lambda x: 5.0, 0.2), value=5.2, **near) == REPRODUCED
    assert verdict(table(lambda x: 5.0, 0.2), value=8.0, **near) == NOT_REPRODUCED
    assert verdict(table(lambda x: 5.0, 5.0, repeats=2, points=(1.0,)), value=9.0, **near) == OPEN


def test_one_selection_against_another() -> None:
    where = {"where": {"x": {"above": 2}}, "than": {"x": {"at_most": 2}}, "measure": "m"}
    assert verdict(table(lambda x: x, 0.2), check="larger", **where) == REPRODUCED
    assert verdict(table(lambda x: x, 0.2), check="smaller", **where) == NOT_REPRODUCED
    assert verdict(table(lambda x: 1.0, 0.2), check="larger", **where) == OPEN


def test_values_are_selected_by_name_too() -> None:
    found = table(lambda x: x, 0.2, points=(1.0, 2.0))
    names = {1.0: "soft", 2.0: "hard"}
    rows = [
        replace(row, task=replace(row.task, settings=(Setting("x", names[s.number], s.number, {}),)))
        for row in found.rows
        for s in row.task.settings
    ]
    where = {"where": {"x": "hard"}, "than": {"x": "soft"}, "measure": "m"}
    assert verdict(Table(rows), check="larger", **where) == REPRODUCED


def test_repeats_that_are_the_same_run_count_once() -> None:
    task = Task("same", "", 0, 0, (Setting("x", "1", 1.0, {}),), "")
    rows = [Row(replace(task, repeat=k), "done", "", {"m": 5.0}) for k in range(4)]
    assert len(Table(rows).done()) == 1
    ((_, runs),) = Table(rows).points("")
    assert len(runs) == 1


def test_what_is_missing_is_not_decidable() -> None:
    empty = Table([Row(Task("a", "", 0, 0, (Setting("x", "1", 1.0, {}),), ""), "failed", "for a reason")])
    for check in ("grows", "falls", "same"):
        assert verdict(empty, check=check, measure="m") == OPEN
    assert verdict(empty, check="equals", measure="m", value=1.0) == OPEN
    assert verdict(empty, check="larger", measure="m", where={"x": 1}, than={"x": 2}) == OPEN


def failing(found: Table, *which: float) -> Table:
    """Return the same runs, of which those at some points failed."""
    lost = [row for row in found.rows if row.value("x") in which]
    return Table([Row(row.task, "failed", "the step is too long") if row in lost else row for row in found.rows])


def evidence(found: Table, **keys: Any) -> str:
    """Return what one statement is judged by."""
    return judge(found, [Expectation.model_validate({"says": "so", **keys})])[0].evidence


def test_a_statement_about_runs_that_all_failed_says_so_and_why() -> None:
    found = table(lambda x: x, 0.2, repeats=2, points=(1.0, 2.0))
    grows = {"check": "grows", "measure": "m"}
    assert evidence(failing(found, 1.0, 2.0), **grows) == "all 4 runs failed: the step is too long"
    where = {"check": "equals", "measure": "m", "value": 2.0, "where": {"x": 2}}
    assert evidence(failing(found, 2.0), **where) == "all 2 runs failed: the step is too long"
    assert "failed" not in evidence(failing(found, 1.0), **where)


def test_a_statement_that_runs_which_failed_leave_open_says_so_and_why() -> None:
    found = failing(table(lambda x: x, 0.2, repeats=2, points=(1.0, 2.0)), 2.0)
    told = evidence(found, check="grows", measure="m")
    assert told == "fewer than two points have results; 2 of 4 runs failed: the step is too long"
    told = evidence(found, check="larger", measure="m", where={"x": 2}, than={"x": 1})
    assert told == "runs to compare are missing; 2 of 4 runs failed: the step is too long"


def test_a_statement_says_what_is_still_to_be_done_whatever_its_verdict() -> None:
    found = table(lambda x: x, 0.2)
    rows = [Row(row.task, "not run") if row.value("x") == 4.0 else row for row in found.rows]
    assert verdict(Table(rows), check="grows", measure="m") == REPRODUCED
    assert evidence(Table(rows), check="grows", measure="m").endswith("; 4 of 16 runs are still to be done")


def test_the_interval_is_students() -> None:
    found = statistic([1.0, 2.0, 3.0, 4.0])
    assert (found.mean, found.deviation) == pytest.approx((2.5, 1.2909944))
    assert (found.low, found.high) == pytest.approx((2.5 - 2.0542, 2.5 + 2.0542), abs=1e-3)
    assert isinf(statistic([1.0]).high)
