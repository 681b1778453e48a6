"""Budgets: how much of a large scene a writer shows."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Discriminator, Field, Tag

from clast.results.run import Run


def _branch(given: Any) -> str:
    return "<word>" if isinstance(given, str) else "<count>"


Budget = Annotated[
    Annotated[Literal["all"], Tag("<word>")] | Annotated[int, Field(ge=0), Tag("<count>")], Discriminator(_branch)
]
"""At most so many, or ``all``."""
FrameBudget = Annotated[
    Annotated[Literal["auto", "all"], Tag("<word>")] | Annotated[int, Field(ge=1), Tag("<count>")],
    Discriminator(_branch),
]
"""At most so many frames, ``all``, or ``auto``: as many as keep the file at a size that opens."""


def most(budget: int | str) -> int | None:
    """Return a budget as a number, None for no limit.

    >>> most("all"), most(5)
    (None, 5)
    """
    return None if isinstance(budget, str) else budget


def within(budget: int | str, count: int) -> int:
    """Return how many of ``count`` a budget allows.

    >>> within("all", 7), within(5, 7)
    (7, 5)
    """
    return count if isinstance(budget, str) else min(budget, count)


def chosen_frames(run: Run, frames: int | str, frame_bytes: float, room: float) -> list[int]:
    """Return the numbers of the frames to write, evenly spread, the first and the last among them.

    Parameters
    ----------
    run : Run
    frames : int, "auto" or "all"
    frame_bytes, room : float
        Size of one frame and of all together; ``auto`` takes as many as there is room for, but at least two.
    """
    limit = max(int(room / max(frame_bytes, 1.0)), 2) if frames == "auto" else within(frames, run.n_frames)
    if limit == 1:
        return [run.n_frames - 1]
    spread = np.linspace(0, run.n_frames - 1, min(limit, run.n_frames)).round()
    return [int(k) for k in np.unique(spread)]
