"""The table of a study: one row a run, its values, how it ended and what it measured."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.errors import ClastError
from clast.results.whole_file import whole_file
from clast.studies.axis import Setting
from clast.studies.layout import run_of
from clast.studies.measures import Curve, measure
from clast.studies.tasks import Task
from clast.studies.work import DONE, FAILED, Result

GRID = 201
"""Points of the strain grid on which curves are compared."""


@dataclass(frozen=True)
class Row:
    """One run.

    Attributes
    ----------
    task : Task
    state, reason : str
    measures : mapping of str to float or None
        Empty where the run is not done.
    curve : Curve or None
    """

    task: Task
    state: str
    reason: str = ""
    measures: Mapping[str, float | None] = field(default_factory=dict)
    curve: Curve | None = None

    @property
    def cause(self) -> str:
        """Why the run failed, without the place in its scene file, which is another one in every run."""
        place, _, rest = self.reason.partition(": ")
        return rest if f"{self.task.name}.yaml" in place else self.reason

    def setting(self, axis: str) -> Setting:
        """Return the setting of an axis."""
        return next(each for each in self.task.settings if each.axis == axis)

    def value(self, axis: str) -> float | str:
        """Return the value on an axis: in SI, or its label where it is no number."""
        setting = self.setting(axis)
        return setting.label if setting.number is None else setting.number


@dataclass(frozen=True)
class Table:
    """All runs of a study, in the order of its variants, points and repeats."""

    rows: Sequence[Row]

    @property
    def axes(self) -> list[str]:
        """What is varied."""
        return [setting.axis for setting in self.rows[0].task.settings] if self.rows else []

    @property
    def measures(self) -> list[str]:
        """Names of everything that any run measured."""
        return list(
            dict.fromkeys(name for row in self.rows for name, value in row.measures.items() if value is not None)
        )

    @property
    def variants(self) -> list[str]:
        """Names of the variants."""
        return list(dict.fromkeys(row.task.variant for row in self.rows))

    def done(self, variant: str | None = None) -> list[Row]:
        """Return the runs that have results, of one variant or all; repeats that are the same run count once."""
        found = [row for row in self.rows if row.measures and variant in (None, row.task.variant)]
        return list({(row.task.variant, row.task.point, row.task.name): row for row in found}.values())

    def points(self, variant: str) -> Iterator[tuple[int, list[Row]]]:
        """Return the points of a variant with their finished runs."""
        rows = self.done(variant)
        for point in dict.fromkeys(row.task.point for row in rows):
            yield point, [row for row in rows if row.task.point == point]


def gather(folder: Path, tasks: Sequence[Task], states: Mapping[str, Result]) -> Table:
    """Read what every run left behind; a run whose results cannot be read counts as failed."""
    read: dict[str, Row] = {}
    rows = []
    for task in tasks:
        if task.name not in read:
            read[task.name] = _row(folder, task, states[task.name])
        known = read[task.name]
        rows.append(Row(task, known.state, known.reason, known.measures, known.curve))
    return Table(rows)


def _row(folder: Path, task: Task, result: Result) -> Row:
    if result.state != DONE:
        return Row(task, result.state, result.reason)
    try:
        found, curve = measure(run_of(folder, task.name))
    except ClastError as error:
        advice = f"remove {run_of(folder, task.name)} and run the study again"
        return Row(task, FAILED, f"{' '.join(str(error).split())}; {advice}")
    return Row(task, DONE, "", found, curve)


def write_csv(table: Table, path: Path) -> None:
    """Write one line a run: its values in SI, how it ended, what it measured; reading gives the same bits."""
    heads = ["run", "variant", "point", "repeat", *table.axes, "state", "reason", *table.measures]
    with whole_file(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heads)
        for row in table.rows:
            values = [row.value(axis) for axis in table.axes]
            measured = [row.measures.get(name) for name in table.measures]
            writer.writerow([*_what(row.task), *map(_text, values), row.state, row.reason, *map(_text, measured)])


def _what(task: Task) -> tuple[Any, ...]:
    return task.name, task.variant, task.point, task.repeat


def _text(value: Any) -> str:
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)


def write_hdf5(table: Table, path: Path) -> None:
    """Write the same table with the curves of all runs on one grid of strains."""
    import h5py

    strain, stress, broken = curves(table.rows)
    with whole_file(path) as draft, h5py.File(draft, "w") as file:
        text = h5py.string_dtype()
        for name, column in zip(
            ("run", "variant", "point", "repeat"), zip(*map(_of, table.rows), strict=True), strict=True
        ):
            file.create_dataset(name, data=list(column), dtype=text if isinstance(column[0], str) else np.int64)
        file.create_dataset("state", data=[row.state for row in table.rows], dtype=text)
        for axis in table.axes:
            values = [row.value(axis) for row in table.rows]
            numeric = all(isinstance(value, float) for value in values)
            kind = np.float64 if numeric else text
            file.create_dataset(f"axes/{axis}", data=values if numeric else [str(v) for v in values], dtype=kind)
        for name in table.measures:
            measured = [row.measures.get(name) for row in table.rows]
            file[f"measures/{name}"] = np.array([np.nan if value is None else value for value in measured])
        file["curves/strain"], file["curves/stress_Pa"], file["curves/bonds_broken"] = strain, stress, broken


def _of(row: Row) -> tuple[Any, ...]:
    return _what(row.task)


def curves(
    rows: Sequence[Row], up_to: float | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return curves on one grid, up to the strain that all of them reach.

    Parameters
    ----------
    rows : sequence of Row
    up_to : float, optional
        Strain at which they are cut, where all reach it.

    Returns
    -------
    strain : (201,) float64
    stress, broken : (r, 201) float64
        One row a run; not a number where there is no curve.
    """
    ends = [row.curve.strain[-1] for row in rows if row.curve is not None]
    least = min(ends, default=0.0)
    strain = np.linspace(0.0, least if up_to is None else min(least, up_to), GRID)
    columns = np.full((2, len(rows), GRID), np.nan)
    for k, row in enumerate(rows):
        if row.curve is not None:
            columns[0, k] = np.interp(strain, row.curve.strain, row.curve.stress)
            columns[1, k] = np.interp(strain, row.curve.strain, row.curve.broken)
    return strain, columns[0], columns[1]
