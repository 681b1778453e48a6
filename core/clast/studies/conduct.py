"""Conducting a study: hand its runs to workers, hear how they end, and go on when workers die."""

from __future__ import annotations

import shutil
from collections import Counter, deque
from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from contextlib import suppress
from pathlib import Path

from clast.errors import RunError
from clast.studies.executors import Workers
from clast.studies.layout import STOP, failure_of, run_of
from clast.studies.work import DONE, FAILED, Result, is_done, perform

STRIKES = 2
"""How many workers may die with the same run before it counts as failed."""

AHEAD = 64
"""Runs handed to the executor at a time: enough for any number of workers, few enough to stop at once."""

LEAST_ROOM = 64 * 2**20
"""Bytes on the disk below which nothing more is begun."""

LOOK_EVERY = 0.5
"""Seconds between two looks at what goes on."""


class Audience:
    """Hears how a study goes; this one says nothing."""

    def begins(self, asked: int, done: int) -> None:
        """Hear that runs start, and how many are there already."""

    def ended(self, result: Result) -> None:
        """Hear how a run ended."""

    def waits(self) -> None:
        """Hear, now and then, that runs go on."""


def conduct(folder: Path, names: Sequence[str], workers: Workers, audience: Audience) -> dict[str, Result]:
    """Do all runs of a study that are not done yet.

    Parameters
    ----------
    folder : Path
        Of the study, with the scene of every run.
    names : sequence of str
    workers : Workers
    audience : Audience

    Returns
    -------
    dict
        How each run ended, by name; runs that were done before are not among them.

    Raises
    ------
    RunError
        If the disk is full. Runs that are done stay.
    KeyboardInterrupt
        After Ctrl-C or SIGTERM, when all runs have been stopped behind a checkpoint.
    """
    left = deque(name for name in dict.fromkeys(names) if not is_done(folder, name))
    audience.begins(len(set(names)), len(set(names)) - len(left))
    found: dict[str, Result] = {}
    strikes: Counter[str] = Counter()
    (folder / STOP).unlink(missing_ok=True)
    while left:
        alone = strikes[left[0]] > 0  # a run with which a worker died shows by itself whether it was the reason
        shift = _Shift(folder, workers, 1 if alone else AHEAD)
        results, lost = shift.work(left, audience, only_one=alone)
        found |= results
        for name in lost:
            strikes[name] += 1
            if strikes[name] < STRIKES or not alone:
                left.append(name)
            else:
                found[name] = Result(name, FAILED, _DIED.format(count=strikes[name]), 0.0)
                _tell(folder, found[name], audience)
        left = deque(sorted(left, key=lambda name: strikes[name] > 0))
    return found


_DIED = "{count} workers died with this run: out of memory, or a crash in a library; 'clast check' tells what it needs"


def _tell(folder: Path, result: Result, audience: Audience) -> None:
    """Tell how a run ended, and leave the reason of a failure for whoever gathers the runs later."""
    failure = failure_of(folder, result.name)
    with suppress(OSError):  # a disk that takes no more costs this note alone: runs go on
        if result.state == FAILED:
            failure.parent.mkdir(exist_ok=True)
            failure.write_text(f"{result.reason}\n", encoding="utf-8")
        else:
            failure.unlink(missing_ok=True)
    audience.ended(result)


class _Shift:
    """The same workers, until their work is done or one of them dies."""

    def __init__(self, folder: Path, workers: Workers, ahead: int) -> None:
        self.folder, self.workers, self.ahead = folder, workers, ahead
        self.running: dict[Future[Result], str] = {}
        self.found: dict[str, Result] = {}

    def work(self, left: deque[str], audience: Audience, only_one: bool) -> tuple[dict[str, Result], list[str]]:
        """Do runs until none is left; return how they ended, and those whose workers died."""
        try:
            self._hand_out(left)
            while self.running:
                self._hear(audience)
                if not only_one:
                    self._hand_out(left)
            return self.found, []
        except BrokenExecutor:
            self.workers.drop()
            return self.found, self._lost(left)
        except KeyboardInterrupt:
            self._stop(audience)
            raise

    def _hand_out(self, left: deque[str]) -> None:
        while left and len(self.running) < self.ahead:
            self._look_for_room()
            future = self.workers.take().submit(perform, str(self.folder), left[0])
            self.running[future] = left.popleft()

    def _look_for_room(self) -> None:
        if shutil.disk_usage(self.folder).free < LEAST_ROOM:
            for future in self.running:
                future.cancel()
            raise RunError(
                f"{self.folder}: less than {LEAST_ROOM >> 20} MB are left on this disk, so no more runs are begun; "
                "those that are done stay. Make room and run the study again"
            )

    def _hear(self, audience: Audience) -> None:
        ended, _ = wait(self.running, timeout=LOOK_EVERY, return_when=FIRST_COMPLETED)
        audience.waits()
        for future in ended:
            result = self._result(future)
            self.found[self.running.pop(future)] = result
            _tell(self.folder, result, audience)

    def _result(self, future: Future[Result]) -> Result:
        try:
            return future.result()
        except BrokenExecutor:
            raise
        except CancelledError as error:
            raise RunError(f"{self.folder}: the workers are gone; finished runs stay. Run the study again") from error
        except Exception as error:  # a cluster has its own errors for workers that died
            return Result(self.running[future], FAILED, f"{type(error).__name__}: {error}", 0.0)

    def _lost(self, left: deque[str]) -> list[str]:
        """Return the runs that had begun when workers died; hand the others back."""
        unfinished = list(self.running.values())
        begun = [name for name in unfinished if run_of(self.folder, name).exists()]
        left.extendleft(name for name in reversed(unfinished) if name not in begun)
        return begun or unfinished

    def _stop(self, audience: Audience) -> None:
        """Ask all runs to stop behind a checkpoint, and wait for them."""
        (self.folder / STOP).touch()
        for future in self.running:
            future.cancel()
        with suppress(BrokenExecutor):
            while self.running:
                self.running = {f: name for f, name in self.running.items() if not f.cancelled()}
                self._hear(audience)
        (self.folder / STOP).unlink(missing_ok=True)


def states(folder: Path, names: Sequence[str], found: dict[str, Result]) -> dict[str, Result]:
    """Return how every run of a study stands: as told, or as its folder shows."""
    return {name: found[name] if name in found else _as_left(folder, name) for name in names}


def _as_left(folder: Path, name: str) -> Result:
    failure = failure_of(folder, name)
    if is_done(folder, name):
        return Result(name, DONE, "", 0.0)
    if failure.is_file():
        return Result(name, FAILED, failure.read_text(encoding="utf-8").strip(), 0.0)
    return Result(name, "not run", "", 0.0)
