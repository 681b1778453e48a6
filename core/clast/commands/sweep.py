"""``clast sweep``: run a study, show how it goes, and write its tables and plots."""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from clast.commands.live_bar import LiveBar
from clast.errors import RefusedError
from clast.forecast import duration
from clast.results.run_folder import locked
from clast.studies import layout
from clast.studies.conduct import Audience, conduct, states
from clast.studies.config import StudyConfig
from clast.studies.executors import Maker, Workers
from clast.studies.outcome import StudyOutcome, conclude
from clast.studies.prepare import prepare
from clast.studies.tasks import Task
from clast.studies.verdict import NOT_REPRODUCED, OPEN, REPRODUCED
from clast.studies.work import DONE, FAILED, Result

PLAIN_EVERY = 5.0
COLOURS = {REPRODUCED: "green", NOT_REPRODUCED: "red", OPEN: "yellow"}


def sweep(study: StudyConfig, folder: Path, maker: Maker | None) -> StudyOutcome:
    """Run what is missing of a study, and write what all of it says.

    Parameters
    ----------
    study : StudyConfig
    folder : Path
        Made when missing; runs that are done in it are not repeated.
    maker : Maker or None
        None only gathers what is there.

    Raises
    ------
    ClastError
        With a message for the user.
    KeyboardInterrupt
        After Ctrl-C or SIGTERM; tables of what is done are written first.
    """
    found = prepare(study, folder)
    names = [task.name for task in found]
    results: dict[str, Result] = {}
    try:
        if maker is not None:
            with locked(folder, "study"), console_audience() as audience, Workers(maker) as workers:
                results = conduct(folder, names, workers, audience)
                audience.close(maker.workers)
    finally:
        outcome = conclude(study, folder, found, states(folder, names, results))
    for row in failures(outcome):
        if row.task.name not in results:  # what failed just now was told at once
            print(f"failed: {row.task.name}: {row.reason}")
    return outcome


def find_study(folder: Path) -> None:
    """Refuse to gather runs where none can be.

    Raises
    ------
    RunError
        If the folder is none of a study.
    """
    if not (folder / layout.STUDY).is_file():
        found = "holds no study" if folder.exists() else "there is no such folder"
        raise RefusedError(
            f"{folder}: {found}, so there is nothing to gather; name its folder with -o, or run it first"
        )


class Lines(Audience):
    """Progress as plain lines."""

    def __init__(self) -> None:
        self.asked = self.done = self.failed = self.here = 0
        self.whole = False
        self.busy = 0.0
        self.begun = self.told = time.monotonic()

    def __enter__(self) -> Lines:
        """Start."""
        return self

    def __exit__(self, *reason: object) -> None:
        """End."""

    def expect(self, asked: int) -> None:
        """Hear how many runs there will be in all, where they come bit by bit."""
        self.asked, self.whole = asked, True
        self.say(f"{asked} runs")

    def begins(self, asked: int, done: int) -> None:
        """Tell how much there is to do."""
        self.done += done
        if not self.whole:
            self.asked, self.begun = asked, time.monotonic()
            self.say(f"{asked} runs" + (f", {done} of them done already" if done else ""))

    def ended(self, result: Result) -> None:
        """Tell how a run ended; failures at once."""
        self.busy += result.seconds
        self.done += result.state == DONE
        self.here += result.state == DONE
        self.failed += result.state == FAILED
        if result.state == FAILED:
            self.say(f"failed: {result.name}: {result.reason}")
        self.show()

    def say(self, text: str) -> None:
        """Print one line at once."""
        print(text, flush=True)

    def show(self) -> None:
        """Tell where the study is, now and then."""
        if time.monotonic() - self.told >= PLAIN_EVERY:
            self.told = time.monotonic()
            self.say(self.status())

    def close(self, workers: int | None) -> None:
        """Tell how long it took, and how much of that the workers were at their runs."""
        seconds = time.monotonic() - self.begun
        if self.here and workers is not None:
            share = self.busy / (seconds * min(workers, self.here))
            self.say(f"{self.here} runs in {duration(seconds)}; {workers} workers were busy {share:.0%} of the time")

    def status(self) -> str:
        """Return how many runs are done, and how long the rest may take."""
        left = self.asked - self.done - self.failed
        text = f"{self.done} of {self.asked} runs done" + (f", {self.failed} failed" if self.failed else "")
        if self.here and left:
            text += f", {duration((time.monotonic() - self.begun) / self.here * left)} left"
        return text


class Bar(LiveBar, Lines):
    """Progress as a live bar, for terminals."""

    def show(self) -> None:
        """Move the bar."""
        self.move(self.status(), self.done + self.failed, self.asked)


def console_audience() -> Lines:
    """Return a bar for terminals, plain lines for everything else."""
    return Bar() if sys.stdout.isatty() else Lines()


def print_prepared(folder: Path, found: Sequence[Task]) -> None:
    """Print how to run the scenes of a study one by one."""
    scenes = folder / "scenes"
    print(
        f"{len({task.name for task in found})} scenes are in {scenes}, their names in {folder / layout.LIST}. "
        "Run each NAME, anywhere, with\n"
        f"  clast run {scenes}/NAME.yaml -o {folder / 'runs'}/NAME\n"
        "then run the study with --collect"
    )


def print_outcome(outcome: StudyOutcome) -> None:
    """Print the table of points, the verdicts, and where everything is."""
    from rich.console import Console
    from rich.table import Table as Drawn

    console = Console(width=None if sys.stdout.isatty() else 160)
    drawn = Drawn(box=None, pad_edge=False)
    heads, rows = outcome.point_table()
    for head in heads:
        drawn.add_column(head, justify="left" if head in ("variant", *outcome.table.axes) else "right")
    for row in rows:
        drawn.add_row(*row)
    console.print(drawn)
    for verdict in outcome.verdicts:
        said = f"{verdict.expectation.says}" + (f" [{verdict.variant}]" if verdict.variant else "")
        console.print(f"{verdict.verdict}: ", style=COLOURS[verdict.verdict], end="", highlight=False)
        console.print(f"{said}: {verdict.evidence}", highlight=False, markup=False, soft_wrap=True)
    for told in filter(None, (outcome.told(), outcome.open_peaks())):
        console.print(told, highlight=False, markup=False, soft_wrap=True)
    for path in outcome.written:
        console.print(f"  {path}", highlight=False, soft_wrap=True)


def failures(outcome: StudyOutcome) -> Sequence[Any]:
    """Return the runs that failed."""
    return [row for row in outcome.table.rows if row.state == FAILED]
