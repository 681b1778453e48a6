"""``clast report``: one HTML file about runs, a sweep or a calibration."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from clast.errors import ConfigError

FILE = "report.html"
ENTRY_POINT = "clast.report"
"""Under which a package offers to write reports; Clast's own is in ``clast_viz``, which the core does not import."""


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
    chosen = list({folder.resolve(): folder for folder in folders}.values())
    page = output if output is not None else (chosen[0] if len(chosen) == 1 else Path()) / FILE
    for damage in report_writer()(chosen, page):
        print(f"cannot be read: {damage}")
    print(page)


def report_writer() -> Callable[[Sequence[Path], Path], Sequence[str]]:
    """Return what writes pages: ``(folders, page) -> messages about what could not be read``.

    Raises
    ------
    ConfigError
        If no installed package offers it.
    """
    from importlib.metadata import entry_points

    found = [*entry_points(group=ENTRY_POINT)]
    if not found:
        raise ConfigError(f"no installed package writes reports (entry point {ENTRY_POINT!r}); install Clast anew")
    writer: Callable[[Sequence[Path], Path], Sequence[str]] = found[0].load()
    return writer
