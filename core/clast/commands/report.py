"""``clast report``: one HTML file about runs, a sweep or a calibration."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

FILE = "report.html"


def report(folders: Sequence[Path], output: Path | None = None) -> None:
    """Write a report and print its path, and which runs could not be read.

    Parameters
    ----------
    folders : sequence of Path
        Of runs, or of one sweep or calibration; one that is given twice counts once.
    output : Path or None
        The file; where not given, ``report.html`` in the folder, or in the working folder for several.

    Raises
    ------
    ClastError
        If a folder is not that of a run, a sweep or a calibration.
    """
    from clast_viz.report.write import write_report

    chosen = list({folder.resolve(): folder for folder in folders}.values())
    page = output if output is not None else (chosen[0] if len(chosen) == 1 else Path()) / FILE
    for damage in write_report(chosen, page):
        print(f"cannot be read: {damage}")
    print(page)
