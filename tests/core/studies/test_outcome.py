"""What a study tells of its runs beside its tables."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from clast.studies.outcome import StudyOutcome
from clast.studies.table import Row, Table
from clast.studies.tasks import Task


def outcome(*insides: float | None) -> StudyOutcome:
    """Return the outcome of runs whose peak is inside their curve, is not, or that failed."""
    rows = [
        Row(Task(str(k), "", 0, k, (), ""), "failed", "x")
        if inside is None
        else Row(Task(str(k), "", 0, k, (), ""), "done", "", {"peak_inside": inside})
        for k, inside in enumerate(insides)
    ]
    return StudyOutcome(Path("study"), Table(rows), [], [])


def test_runs_that_ended_before_their_peak_are_counted() -> None:
    assert outcome(1.0, 0.0, 0.0, None).open_peaks().startswith("2 of 3 runs ended before their stress had fallen")


def test_nothing_is_said_where_every_peak_is_inside_or_there_is_none() -> None:
    assert outcome(1.0, 1.0, None).open_peaks() == ""
    found: Any = outcome()
    assert found.open_peaks() == ""


def test_the_cause_of_a_failure_is_told_without_the_file_of_its_scene() -> None:
    task = Task("a-1", "", 0, 0, (), "")
    assert (
        Row(task, "failed", "x/scenes/a-1.yaml:3:1: time.step: too long: halve it").cause
        == "time.step: too long: halve it"
    )
    assert Row(task, "failed", "out of memory: 3 GB").cause == "out of memory: 3 GB"
