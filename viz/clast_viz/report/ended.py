"""Ended: how the runs of a study ended, as its table of runs tells, with links to those that have a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from clast.studies.layout import run_of
from clast_viz.report.links import address
from clast_viz.report.measured import number
from clast_viz.report.tables import Record

COLUMNS = ("run", "variant", "point", "repeat", "state", "reason")
"""Of every table of runs."""


class Ended(NamedTuple):
    """How a run ended: the folder it lies in, and the cells of its row."""

    name: str
    folder: str
    cells: list[str]
    state: str
    reason: str


def ended(runs: Sequence[Record], shown: Sequence[str], folder: Path, page: Path) -> list[Ended]:
    """Return how runs of a study's folder ended, each with its values in the columns that are shown."""
    return [_ended(row, shown, folder, page) for row in runs]


def _ended(row: Record, shown: Sequence[str], folder: Path, page: Path) -> Ended:
    cells = [*(number(row[name]) for name in shown), row["repeat"]]
    place = run_of(folder, row["run"])
    link = address(place, page) if place.is_dir() else ""
    return Ended(row["run"], link, cells, row["state"], row["reason"])


def axes(runs: Sequence[Record]) -> list[str]:
    """Return what is varied: the columns between the repeat and how a run ended."""
    heads = list(runs[0]) if runs else []
    return heads[heads.index("repeat") + 1 : heads.index("state")] if heads else []
