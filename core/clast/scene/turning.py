"""Walls that turn: about which axes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen

TIMES = (0.0, 1e-6, 1e-3, 0.1, 1.0, 1e3)
"""Times in s at which motions are asked how they turn."""


def spins(motion: Chosen) -> NDArray[np.float64]:
    """Return the angular velocities of a motion at several times, (t, 3) in rad/s; zeros where it does not turn."""
    if motion.part.spin is None:
        return np.zeros((len(TIMES), 3))
    course = motion.part.course(motion.params)
    return np.array([motion.part.spin(course, time) for time in TIMES])
