"""Writing a report: of one or several runs."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path

from clast_viz.report import run_page
from clast_viz.report.html import write_page
from clast_viz.report.opened import open_all


def write_report(folders: Sequence[Path], page: Path) -> list[str]:
    """Write the report about one or several runs; return what is wrong with runs that cannot be read.

    Parameters
    ----------
    folders : sequence of Path
        Run folders, finished or not.
    page : Path
        HTML file to write.

    Raises
    ------
    RunError
        If a folder is not there, or not that of a run.
    """
    with ExitStack() as stack:
        opened = open_all(folders, stack)
        write_page(page, run_page.TEMPLATE, run_page.values_of_runs(opened, page))
    return [each.damage for each in opened if each.damage]
