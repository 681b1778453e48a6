"""Outcome of a study: its table, statistics, verdicts and plots, written into its folder."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from clast.studies import layout
from clast.studies.config import StudyConfig
from clast.studies.statistics import statistic, values_of, write_statistics
from clast.studies.table import Row, Table, gather, write_csv, write_hdf5
from clast.studies.tasks import Task
from clast.studies.verdict import Verdict, judge, write_verdicts
from clast.studies.work import Result

COLUMNS = {
    "peak_stress_Pa": ("peak MPa", 1e-6, 2),
    "strain_at_peak": ("at strain %", 100.0, 1),
    "slope_5_15_Pa": ("slope 5-15 % MPa", 1e-6, 1),
    "largest_drop": ("largest drop %", 100.0, 0),
    "broken_at_end": ("broken at end %", 100.0, 0),
}
"""What the table of points shows: head, factor, decimals."""

INSIDE = "peak_inside"
"""The measure that tells whether a run has seen its peak."""

MOST_LINES = 32
"""Points of a variant that a table shows one by one."""


@dataclass(frozen=True)
class StudyOutcome:
    """What a study left behind: its table, what it says of each statement, and every file."""

    folder: Path
    table: Table
    verdicts: Sequence[Verdict]
    written: Sequence[Path]

    def point_table(self) -> tuple[list[str], list[list[str]]]:
        """Return heads and rows of a table with one line a point: mean ± deviation of the main measures."""
        shown = [name for name in COLUMNS if name in self.table.measures]
        some = [""] if self.table.variants == [""] else ["variant"]
        heads = [*filter(None, some), *self.table.axes, "runs", *(COLUMNS[name][0] for name in shown)]
        rows = []
        for variant in self.table.variants:
            for labels, runs in self._lines(variant):
                cells = [_cell(values_of(runs, name), *COLUMNS[name][1:]) for name in shown]
                rows.append([*([variant] if some[0] else []), *labels, str(len(runs)), *cells])
        return heads, rows

    def _lines(self, variant: str) -> list[tuple[list[str], list[Row]]]:
        """Return labels and runs of every line of the table: the points, or all of them where there are too many."""
        points = list(self.table.points(variant))
        if len(points) <= MOST_LINES:
            return [([setting.label for setting in runs[0].task.settings], runs) for _, runs in points]
        every = [row for _, runs in points for row in runs]
        return [(["all" for _ in self.table.axes], every)]

    def open_peaks(self) -> str:
        """Return how many runs ended before their peak was behind them, in words; empty where none did."""
        return open_peaks(values_of(self.table.done(), INSIDE))

    def told(self) -> str:
        """Return how many runs ended how."""
        states = [row.state for row in self.table.rows]
        counts = {state: states.count(state) for state in dict.fromkeys(states)}
        told = f"{len(states)} runs: " + ", ".join(f"{count} {state}" for state, count in counts.items())
        same = len(states) - len({(row.task.variant, row.task.point, row.task.name) for row in self.table.rows})
        return told + (f"; {same} are repeats that draw no other numbers, and count as the same run" if same else "")


def open_peaks(insides: Sequence[float]) -> str:
    """Return in words how many runs ended before their peak was behind them, from what each measured of it."""
    count = sum(inside == 0.0 for inside in insides)
    if not count:
        return ""
    return (
        f"{count} of {len(insides)} runs ended before their stress had fallen by a fifth from its peak "
        f"({INSIDE} is 0): a later, higher peak is not ruled out; a larger time.end.strain tells"
    )


def _cell(sample: Sequence[float], factor: float, decimals: int) -> str:
    if not sample:
        return "-"
    found = statistic(sample)
    text = f"{factor * found.mean:.{decimals}f}"
    return text if found.runs < 2 else f"{text} ± {factor * found.deviation:.{decimals}f}"


def conclude(study: StudyConfig, folder: Path, tasks: Sequence[Task], states: Mapping[str, Result]) -> StudyOutcome:
    """Read all runs, and write tables, statistics, verdicts and plots."""
    from clast.studies.ensemble import draw_weibull, write_ensemble
    from clast.studies.plots import draw_curves, draw_measures

    for name in layout.SOMETIMES:
        (folder / name).unlink(missing_ok=True)
    table = gather(folder, tasks, states)
    verdicts = judge(table, study.expect)
    written = [folder / layout.RUNS, folder / layout.TABLE, folder / layout.STATISTICS]
    write_csv(table, written[0])
    write_hdf5(table, written[1])
    write_statistics(table, written[2])
    if study.expect:
        written.append(folder / layout.VERDICTS)
        write_verdicts(verdicts, written[-1])
    if draw_curves(table, study.scene, folder / "curves.png"):
        written.append(folder / "curves.png")
    if draw_measures(table, folder / "measures.png"):
        written.append(folder / "measures.png")
    if study.of_accidents:
        if write_ensemble(table, folder / layout.ENSEMBLE):
            written.append(folder / layout.ENSEMBLE)
        if draw_weibull(table, folder / "weibull.png"):
            written.append(folder / "weibull.png")
    return StudyOutcome(folder, table, verdicts, written)
