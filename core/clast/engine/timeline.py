"""Timeline: which step is at what time, when the time step changes now and then."""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil, floor
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray


class Span(NamedTuple):
    """A stretch of equal steps: the step and the time in s at which it begins, and the time step in s."""

    step: int
    time: float
    dt: float


class Timeline:
    """Stretches of equal steps, one after the other.

    Examples
    --------
    >>> timeline = Timeline([Span(0, 0.0, 0.5)])
    >>> timeline.change(4, 0.25)
    >>> timeline.time_of(6), timeline.times(np.array([3, 4, 5])).tolist()
    (2.5, [1.5, 2.0, 2.25])
    """

    def __init__(self, spans: Iterable[Any]) -> None:
        self.spans = [Span(int(step), float(time), float(dt)) for step, time, dt in spans]

    @property
    def dt(self) -> float:
        """The present time step in s."""
        return self.spans[-1].dt

    def change(self, step: int, dt: float) -> None:
        """Take steps of ``dt`` seconds from a step on."""
        self.spans.append(Span(step, self.time_of(step), dt))

    def time_of(self, step: int) -> float:
        """Return the time of a step of the present stretch in s, with the bits of the step loop."""
        begin, time, dt = self.spans[-1]
        return time + (step - begin) * dt

    def times(self, steps: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return the times of any steps so far, in s."""
        found = np.zeros(len(steps))
        for begin, time, dt in self.spans:
            found = np.where(steps >= begin, time + (steps - begin) * dt, found)
        return found

    def next_multiple(self, step: int, every: int) -> int:
        """Return the next step at a multiple of the time that ``every`` steps took at the start."""
        if len(self.spans) == 1:
            return (step // every + 1) * every
        begin, time, dt = self.spans[-1]
        interval = every * self.spans[0].dt
        wanted = (floor(self.time_of(step) / interval + 1e-6) + 1) * interval
        return max(step + 1, begin + ceil((wanted - time) / dt - 1e-6))
