"""Calibration: what `clast calibrate` leaves in its folder, read back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from clast.calibration import layout
from clast.calibration.record import Record as Account
from clast.calibration.record import read_record
from clast.results.reading import read_yaml
from clast_viz.report import ended
from clast_viz.report.tables import Record, read_table

COMMAND = "clast calibrate"


@dataclass(frozen=True)
class Calibration:
    """What a calibration wrote.

    Attributes
    ----------
    folder : Path
    asked : dict
        The calibration file.
    account : Account or None
        What was found; None where the calibration has not ended.
    runs, history : sequence of dict of str to str
        Rows of the tables by their heads; nothing where there is no such table.
    begun : sequence of Path
        Folders of all runs that have one.
    picture : Path or None
        Every target along every parameter.
    """

    folder: Path
    asked: dict[str, Any]
    account: Account | None
    runs: Sequence[Record]
    history: Sequence[Record]
    begun: Sequence[Path]
    picture: Path | None


def is_calibration(folder: Path) -> bool:
    """Tell whether a folder is that of a calibration."""
    return (folder / layout.ASKED).is_file()


def read_calibration(folder: Path) -> Calibration:
    """Read what a calibration left, ended or not.

    Raises
    ------
    RunError
        If a file is not what a calibration writes.
    """
    account, picture = folder / layout.ACCOUNT, folder / layout.PICTURE
    over = account.is_file()
    return Calibration(
        folder=folder,
        asked=read_yaml(folder / layout.ASKED),
        account=read_record(account) if over else None,
        runs=read_table(folder / layout.RUNS, ended.COLUMNS, COMMAND) if over else [],
        history=read_table(folder / layout.HISTORY, ("point", "misfit"), COMMAND) if over else [],
        begun=sorted(each for each in (folder / "runs").glob("*") if each.is_dir()),
        picture=picture if over and picture.is_file() else None,
    )
