"""Timelines of a recording: time always, strain where it only grows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.results.run import Run


@dataclass(frozen=True)
class Timelines:
    """Where each frame lies on the timelines ``time`` and ``strain``.

    rerun knows only time as a continuous axis, so one percent of strain is shown as one second.

    Attributes
    ----------
    frames : tuple of int
        Numbers of the frames that are shown.
    time : (F,) float64
        Time of each frame in s.
    strain : (F,) float64 or None
        Strain of each frame, or None where strain names no frame: no compression, or it turns back.
    """

    frames: tuple[int, ...]
    time: NDArray[np.float64]
    strain: NDArray[np.float64] | None

    @classmethod
    def of(cls, run: Run, frames: Sequence[int]) -> Timelines:
        """Read the timelines of some frames of a run."""
        chosen = np.array(frames, np.intp)
        strain = run.frame_values("strain")[chosen]
        grows = len(strain) > 1 and bool(np.all(np.diff(strain) > 0.0))
        return cls(tuple(frames), run.frame_values("time")[chosen], strain if grows else None)

    def set(self, stream: Any, k: int) -> None:
        """Move the stream to the ``k``-th frame."""
        stream.set_time("time", duration=float(self.time[k]))
        if self.strain is not None:
            stream.set_time("strain", duration=100.0 * float(self.strain[k]))

    def columns(self, time: NDArray[np.float64], strain: NDArray[np.float64] | None) -> list[Any]:
        """Build the index columns of samples taken at ``time`` and ``strain``."""
        import rerun as rr

        columns = [rr.TimeColumn("time", duration=time)]
        if self.strain is not None and strain is not None:
            columns.append(rr.TimeColumn("strain", duration=100.0 * strain))
        return columns

    def since_previous(self, time: NDArray[np.float64], k: int) -> NDArray[np.bool_]:
        """Mark the events after the frame shown before the ``k``-th up to and with that one."""
        earlier = self.time[k - 1] if k else -np.inf
        since: NDArray[np.bool_] = (time > earlier) & (time <= self.time[k])
        return since
