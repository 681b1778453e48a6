"""``clast calibrate``: fit parameters to measurements, show how it goes, and tell what was found."""

from __future__ import annotations

import sys
from pathlib import Path

from rich.console import Console
from rich.table import Table

from clast.calibration import account
from clast.calibration.config import CalibrationConfig
from clast.calibration.fit import Fit, Fitting
from clast.commands.sweep import console_audience
from clast.results.run_folder import locked
from clast.studies.executors import Maker, Workers


def calibrate(config: CalibrationConfig, folder: Path, maker: Maker) -> Fit:
    """Fit the parameters and write what was found.

    Parameters
    ----------
    config : CalibrationConfig
    folder : Path
        Made when missing; runs that are done in it are not repeated.
    maker : Maker

    Raises
    ------
    ClastError
        With a message for the user.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder, "calibration"), console_audience() as audience, Workers(maker) as workers:
        audience.expect(config.points * config.repeats)
        found = Fitting(config, folder, workers, audience).fit()
    print_fit(found)
    for path in account.write(found, folder):
        print(f"  {path}")
    return found


def print_fit(found: Fit) -> None:
    """Print parameters, targets, sensitivities and what cannot be told apart."""
    console = Console(width=None if sys.stdout.isatty() else 160)
    for heads, rows in (account.parameter_rows(found), account.target_rows(found), account.slope_rows(found)):
        drawn = Table(box=None, pad_edge=False)
        for k, head in enumerate(heads):
            drawn.add_column(head, justify="right" if k else "left")
        for row in rows:
            drawn.add_row(*row)
        console.print(drawn)
        console.print()
    for told in account.confusions(found):
        console.print(f"{told}.", highlight=False, soft_wrap=True)
