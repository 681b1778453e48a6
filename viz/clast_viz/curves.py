"""What is read off a compression curve before it is drawn."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.results.run import Run

TIME_UNITS = ((1.0, "s"), (1e3, "ms"), (1e6, "µs"), (1e9, "ns"))


class Peak(NamedTuple):
    """Highest point of a stress–strain curve; stress in Pa."""

    strain: float
    stress: float


def has_compression(run: Run) -> bool:
    """Tell whether the run has a stress–strain curve with at least two samples."""
    return "stress_Pa" in run.curves and len(run.curves["stress_Pa"]) > 1


def time_axis(seconds: NDArray[np.float64]) -> tuple[NDArray[np.float64], str]:
    """Return times in a unit in which they read well, and the label of their axis.

    >>> time_axis(np.array([0.0, 2e-4]))
    (array([  0., 200.]), 'time [µs]')
    """
    longest = float(np.max(seconds, initial=0.0))
    factor, unit = next((each for each in TIME_UNITS if longest * each[0] >= 1.0), TIME_UNITS[-1])
    return factor * seconds, f"time [{unit}]"


def peak(run: Run) -> Peak:
    """Return the highest point of the stress–strain curve; the run must have one."""
    at = int(np.nanargmax(run.curves["stress_Pa"]))
    return Peak(float(run.curves["strain"][at]), float(run.curves["stress_Pa"][at]))


def peak_frame(run: Run) -> int:
    """Return the last frame not after the peak stress, or the last frame of a run without a curve.

    The last one *before*, because at the peak itself the load is already being released.
    """
    if not has_compression(run):
        return run.n_frames - 1
    after = np.flatnonzero(run.frame_values("strain") > peak(run).strain * (1.0 + 1e-9))
    return max(int(after[0]) - 1, 0) if len(after) else run.n_frames - 1
