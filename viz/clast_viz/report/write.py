"""Writing a report: of runs, of a sweep, or of a calibration."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

from clast.errors import RefusedError
from clast_viz.report import calibration_page, run_page, sweep_page
from clast_viz.report.calibration import is_calibration, read_calibration
from clast_viz.report.html import write_page
from clast_viz.report.opened import open_all
from clast_viz.report.sweep import is_sweep, read_sweep


def write_report(folders: Sequence[Path], page: Path) -> list[str]:
    """Write the report about runs, a sweep or a calibration; return what is wrong with runs that cannot be read.

    Parameters
    ----------
    folders : sequence of Path
        Run folders, finished or not; or the folder of one sweep or calibration.
    page : Path
        HTML file to write.

    Raises
    ------
    RunError
        If a folder is not there, or not that of a run; or a sweep or calibration does not come alone, or what it
        left cannot be read.
    """
    if any(is_sweep(folder) or is_calibration(folder) for folder in folders):
        _write_study(folders, page)
        return []
    with ExitStack() as stack:
        opened = open_all(folders, stack)
        write_page(page, run_page.TEMPLATE, run_page.values_of_runs(opened, page))
    return [each.damage for each in opened if each.damage]


def _write_study(folders: Sequence[Path], page: Path) -> None:
    if len(folders) > 1:
        raise RefusedError(
            "a sweep or a calibration has a report of its own; give its folder alone, or folders of runs only"
        )
    folder = folders[0]
    if is_sweep(folder):
        write_page(page, sweep_page.TEMPLATE, sweep_page.values_of_sweep(read_sweep(folder), page))
    else:
        values = calibration_page.values_of_calibration(read_calibration(folder), page)
        write_page(page, calibration_page.TEMPLATE, values)
