"""Writing a report: of runs, or of a sweep."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

from clast.errors import RunError
from clast_viz.report import run_page, sweep_page
from clast_viz.report.html import write_page
from clast_viz.report.opened import open_all
from clast_viz.report.sweep import is_sweep, read_sweep


def write_report(folders: Sequence[Path], page: Path) -> list[str]:
    """Write the report about one or several runs, or a sweep; return what is wrong with runs that cannot be read.

    Parameters
    ----------
    folders : sequence of Path
        Run folders, finished or not; or the folder of one sweep.
    page : Path
        HTML file to write.

    Raises
    ------
    RunError
        If a folder is not there, or not that of a run; or a sweep does not come alone, or has no table to read.
    """
    if any(is_sweep(folder) for folder in folders):
        if len(folders) > 1:
            raise RunError("a sweep has a report of its own; give its folder alone, or folders of runs only")
        write_page(page, sweep_page.TEMPLATE, sweep_page.values_of_sweep(read_sweep(folders[0]), page))
        return []
    with ExitStack() as stack:
        opened = open_all(folders, stack)
        write_page(page, run_page.TEMPLATE, run_page.values_of_runs(opened, page))
    return [each.damage for each in opened if each.damage]
