"""Sweep: the tables that `clast sweep` leaves in its folder, read back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from clast.errors import RefusedError
from clast.results.reading import read_yaml
from clast.studies.layout import ENSEMBLE, RUNS, STATISTICS, STUDY, VERDICTS
from clast_viz.report import ended
from clast_viz.report.tables import Record, read_table

COMMAND = "clast sweep"
OF_POINT = ("variant", "point", "measure", "mean", "deviation", "runs")
OF_ENSEMBLE = (
    *("variant", "measure", "grains", "mean", "mean_low", "mean_high"),
    *("deviation", "deviation_low", "deviation_high", "weibull_modulus"),
)
OF_VERDICT = ("says", "source", "variant", "verdict", "evidence")


@dataclass(frozen=True)
class Sweep:
    """What a sweep wrote.

    Attributes
    ----------
    folder : Path
    study : dict
        The study file.
    runs, statistics, ensemble, verdicts : sequence of dict of str to str
        Rows of the tables by their heads; nothing where there is no such table.
    axes : sequence of str
        What is varied.
    pictures : sequence of Path
        The plots.
    """

    folder: Path
    study: dict[str, Any]
    runs: Sequence[Record]
    statistics: Sequence[Record]
    ensemble: Sequence[Record]
    verdicts: Sequence[Record]
    axes: Sequence[str]
    pictures: Sequence[Path]


def is_sweep(folder: Path) -> bool:
    """Tell whether a folder is that of a sweep."""
    return (folder / STUDY).is_file()


def read_sweep(folder: Path) -> Sweep:
    """Read the tables of a sweep.

    Raises
    ------
    RunError
        If there is no table of runs yet, or a table is not what a sweep writes.
    """
    if not (folder / RUNS).is_file():
        raise RefusedError(f"{folder}: a sweep without {RUNS}; `clast sweep` writes it when its runs have ended")
    runs = read_table(folder / RUNS, ended.COLUMNS, COMMAND)
    return Sweep(
        folder=folder,
        study=read_yaml(folder / STUDY),
        runs=runs,
        statistics=read_table(folder / STATISTICS, OF_POINT, COMMAND),
        ensemble=read_table(folder / ENSEMBLE, OF_ENSEMBLE, COMMAND),
        verdicts=read_table(folder / VERDICTS, OF_VERDICT, COMMAND),
        axes=ended.axes(runs),
        pictures=sorted(folder.glob("*.png")),
    )
