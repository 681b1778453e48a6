"""What is read off a compression curve before it is drawn."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from clast.results.run import Run


class Peak(NamedTuple):
    """Highest point of a stress–strain curve; stress in Pa."""

    strain: float
    stress: float


def has_compression(run: Run) -> bool:
    """Tell whether the run has a stress–strain curve with at least two samples."""
    return "stress_Pa" in run.curves and len(run.curves["stress_Pa"]) > 1


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
