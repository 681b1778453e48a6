"""Watch: progress, wall-clock checkpoints and orderly stops, without touching the results."""

from __future__ import annotations

import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING, Any, NoReturn

from clast.errors import RunError

if TYPE_CHECKING:
    from clast.simulation import Simulation

LOOK_EVERY = 0.2
GO_ON = "go on with --resume"
OUT_OF_TIME = 75
"""Exit code of a run whose wall-clock time is up: what ``sysexits.h`` calls a temporary failure, that is, try again."""


class RunInterruptedError(RunError):
    """The run was asked to stop by Ctrl-C or SIGTERM; its exit code is 128 plus the signal's number."""

    def __init__(self, number: int, advice: str = GO_ON) -> None:
        super().__init__(f"stopped by {signal.Signals(number).name}; {advice}")
        self.exit_code = 128 + number


class OutOfTimeError(RunInterruptedError):
    """The wall-clock time that the run was given is up: it ends as after Ctrl-C, with an exit code of its own."""

    def __init__(self, most: float, simulation: Simulation) -> None:
        RunError.__init__(
            self,
            f"stopped after {most:g} s of wall-clock time (time.wall_time), at {simulation.time:.4g} s, step "
            f"{simulation.step} of {simulation.last_step}; {GO_ON}",
        )
        self.exit_code = OUT_OF_TIME


class StopError(KeyboardInterrupt):
    """A signal asked to stop: what Ctrl-C raises in Python, for SIGTERM too."""

    def __init__(self, number: int, advice: str = "") -> None:
        super().__init__("; ".join(filter(None, (f"stopped by {signal.Signals(number).name}", advice))))
        self.exit_code = 128 + number
        self.number = number


@contextmanager
def stoppable(advice: str = "") -> Iterator[None]:
    """Let SIGINT and SIGTERM raise :class:`StopError` meanwhile, so that everything opened is closed on the way out.

    Parameters
    ----------
    advice : str
        How to go on, for whoever stops it.
    """

    def stop(number: int, frame: FrameType | None) -> NoReturn:
        raise StopError(number, advice)

    with signals_to(stop):
        yield


@contextmanager
def signals_to(handler: Callable[[int, FrameType | None], Any]) -> Iterator[None]:
    """Hand SIGINT and SIGTERM to a function meanwhile, where Python allows it: in the main thread."""
    mine = threading.current_thread() is threading.main_thread()
    before = {number: signal.signal(number, handler) for number in ((signal.SIGINT, signal.SIGTERM) if mine else ())}
    try:
        yield
    finally:
        for number, earlier in before.items():
            signal.signal(number, earlier)


MEMORY = 30.0
"""Time in s over which the rate that is told is a mean: output and searches for neighbours come in between."""


class Pace:
    """Steps per second of late: a mean in which what is past counts less and less.

    >>> pace = Pace()
    >>> pace.add(100, 1.0)
    100.0
    >>> round(pace.add(0, 1.0))
    49
    """

    def __init__(self) -> None:
        self.steps = self.seconds = 0.0

    def add(self, steps: int, seconds: float) -> float:
        """Note steps and the wall-clock time they took; return the mean in steps per second."""
        fades = math.exp(-seconds / MEMORY)
        self.steps = fades * self.steps + steps
        self.seconds = fades * self.seconds + seconds
        return self.steps / max(self.seconds, 1e-9)


class Watch:
    """Observer that looks several times a second, wherever the run is.

    Parameters
    ----------
    show : callable
        Called with the simulation and the steps per second of late at every look but the first.
    checkpoint : callable
        Called when it is time for a checkpoint.
    interval : float
        Wall-clock time between checkpoints in s.
    most : float, optional
        Wall-clock time in s after which the run ends as after a signal.
    begun : float, optional
        When that time began to count, by ``time.monotonic``.
    """

    def __init__(
        self,
        show: Callable[[Simulation, float], Any],
        checkpoint: Callable[[], Any],
        interval: float,
        most: float | None = None,
        begun: float = 0.0,
    ) -> None:
        self.show, self.checkpoint, self.interval = show, checkpoint, interval
        self.most, self.begun = most, begun
        self.stride = 1
        self.due = 0
        self.looked = self.saved = time.monotonic()
        self.step: int | None = None
        self.pace = Pace()
        self.signal = 0

    def __enter__(self) -> Watch:
        """Take over SIGINT and SIGTERM."""
        self._signals = signals_to(self._note)
        self._signals.__enter__()
        return self

    def __exit__(self, *reason: object) -> None:
        """Give the signals back."""
        self._signals.__exit__(None, None, None)

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.signal = number

    def next_step(self, step: int) -> int | None:
        """Return the step that is reached about a fifth of a second after the last look."""
        return max(self.due, step + 1)

    def observe(self, simulation: Simulation) -> None:
        """Show progress, save when due, stop when asked.

        Raises
        ------
        RunInterruptedError
            After a signal, or when the wall-clock time is up.
        """
        now = time.monotonic()
        if self.step is not None:
            steps, seconds = simulation.step - self.step, now - self.looked
            self.stride = max(1, min(10 * self.stride, int(steps / max(seconds, 1e-9) * LOOK_EVERY)))
            self.show(simulation, self.pace.add(steps, seconds))
        self.looked, self.step = now, simulation.step
        self.due = simulation.step + self.stride
        if self.signal:
            raise RunInterruptedError(self.signal)
        if self.most is not None and now - self.begun >= self.most and simulation.step < simulation.last_step:
            raise OutOfTimeError(self.most, simulation)
        if now - self.saved >= self.interval:
            self.checkpoint()
            self.saved = time.monotonic()
