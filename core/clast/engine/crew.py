"""The threads that share the steps of a large scene."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from clast.engine.chunks import LARGE
from clast.engine.kernels.layout import DONE, LANES
from clast.engine.state import Floats, Team, World

Advance = Callable[[World, int, Team], int]


def processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def shares(work: Floats, size: int) -> list[int]:
    """Return where each of ``size`` threads' chunks begin, and the end, so that all have about the same work.

    >>> shares(np.array([3.0, 1.0, 1.0, 1.0]), 2)
    [0, 1, 4]
    """
    done = np.concatenate([[0.0], np.cumsum(work)])
    return [int(np.abs(done - done[-1] * rank / size).argmin()) for rank in range(size)] + [len(work)]


class Crew:
    """One thread for each share of a scene's chunks; the caller's thread is the first of them.

    Attributes
    ----------
    size : int
        Number of threads: no more than asked for (None: any number), than processors, and than chunks.
    told : str
        What a user should know of it; empty if nothing.
    """

    def __init__(self, asked: int | None, world: World) -> None:
        chunks = len(world.chunks) - 1
        self.size = max(1, min(asked or processors(), processors(), chunks))
        self.told = ""
        if self.size > 1:
            self.told = f"{self.size} threads share the steps, {chunks} chunks of particles among them"
        elif (asked or 1) > 1:
            why = f"only scenes of more than {LARGE} particles are shared" if chunks == 1 else "there is one processor"
            self.told = f"one thread computes the steps: {why}"
        barrier = np.zeros(16, np.int64)
        work = np.diff(world.chunks.astype(float)) + LANES * np.diff(world.bonds.begin.astype(float))
        bounds = shares(work, self.size)
        self._alone = Team(0, 1, barrier, 0, chunks)
        self._teams = [Team(rank, self.size, barrier, bounds[rank], bounds[rank + 1]) for rank in range(self.size)]
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
            first = advance(world, min(now, step), self._alone)
            if first != DONE:
                return first
        others = [self._threads.submit(advance, world, step, team) for team in self._teams[1:]]
        result = advance(world, step, self._teams[0])
        for other in others:
            other.result()
        return result
