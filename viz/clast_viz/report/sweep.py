"""Sweep: the tables that `clast sweep` leaves in its folder, read back."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from clast.errors import RunError, one_line
from clast.results.reading import read_yaml
from clast.studies.layout import RUNS, STATISTICS, STUDY, VERDICTS

Record = dict[str, str]


@dataclass(frozen=True)
class Sweep:
    """What a sweep wrote.

    Attributes
    ----------
    folder : Path
    study : dict
        The study file.
    runs, statistics, verdicts : sequence of dict of str to str
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
        raise RunError(f"{folder}: a sweep without {RUNS}; `clast sweep` writes it when its runs have ended")
    runs = _table(folder / RUNS, ("run", "variant", "point", "repeat", "state", "reason"))
    heads = list(runs[0]) if runs else []
    return Sweep(
        folder=folder,
        study=read_yaml(folder / STUDY),
        runs=runs,
        statistics=_table(folder / STATISTICS, ("variant", "point", "measure", "mean", "deviation", "runs")),
        verdicts=_table(folder / VERDICTS, ("says", "source", "variant", "verdict", "evidence")),
        axes=heads[heads.index("repeat") + 1 : heads.index("state")] if heads else [],
        pictures=sorted(folder.glob("*.png")),
    )


def _table(path: Path, needed: Sequence[str]) -> list[Record]:
    """Read a table; nothing where there is none."""
    if not path.is_file():
        return []
    try:
        with path.open(newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file, restval="")
            missing = [name for name in needed if name not in (reader.fieldnames or [])]
            rows = [{key: value for key, value in row.items() if key is not None} for row in reader]
    except (UnicodeDecodeError, csv.Error) as error:
        raise _unreadable(path, one_line(error)) from error
    if missing:
        raise _unreadable(path, f"it has no column {', '.join(missing)}")
    return rows


def _unreadable(path: Path, reason: str) -> RunError:
    return RunError(f"{path}: cannot be read ({reason}); run `clast sweep` again, which writes it anew")
