"""The threads that share the steps of a large scene."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from clast.engine.kernels.layout import DONE
from clast.engine.state import Team, World

Advance = Callable[[World, int, Team], int]


def processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class Crew:
    """One thread for each share of a scene's chunks; the caller's thread is the first of them.

    Attributes
    ----------
    size : int
        Number of threads: no more than asked for, than processors, and than chunks.
    """

    def __init__(self, asked: int, chunks: int) -> None:
        self.size = max(1, min(asked, processors(), chunks))
        barrier = np.zeros(16, np.int64)
        self._teams = [Team(rank, self.size, barrier) for rank in range(self.size)]
        self._threads = ThreadPoolExecutor(self.size - 1, "clast") if self.size > 1 else None
        self._compiled = False

    def advance(self, advance: Advance, world: World, step: int, now: int) -> int:
        """Advance a world from step ``now`` to ``step`` together; returns what the step loop returns.

        The first call compiles, alone: a thread that fails to compile would leave the others waiting.
        """
        if self._threads is None:
            return advance(world, step, self._teams[0])
        if not self._compiled:
            self._compiled = True
            first = advance(world, min(now, step), Team(0, 1, self._teams[0].barrier))
            if first != DONE:
                return first
        others = [self._threads.submit(advance, world, step, team) for team in self._teams[1:]]
        result = advance(world, step, self._teams[0])
        for other in others:
            other.result()
        return result
