"""Swift walls: walls that go so far in one step that contacts cannot follow them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig

Floats = NDArray[np.float64]
LOOKS = 500
"""How often a motion is asked for its velocity."""
MOST_WAY = 0.5
"""Longest way of a wall in one step, as a share of the smallest radius."""


def swift_walls(config: SceneConfig, radius: float, step: float, steps: int) -> list[str]:
    """Return a sentence for each wall that is known to go farther in a step than contacts can follow.

    Parameters
    ----------
    config : SceneConfig
    radius : float
        The smallest, in m.
    step : float
        In s.
    steps : int
        How many there are to the end.
    """
    times = step * np.linspace(0.0, steps, LOOKS)
    told = []
    for name, wall in config.walls.items():
        way = step * max([0.0, *(fastest(stage.motion, times) for stage in wall.stages)])
        if way > MOST_WAY * radius:
            text = (
                f"it goes up to {way:.3g} m in a step of {step:.3g} s, {way / radius:.2g} times the smallest radius: "
                "it passes through particles. Slow it down, or take a time.step below "
                f"{MOST_WAY * radius / way * step:.2g} s"
            )
            told.append(config.remark(("walls", name), text))
    return told


def fastest(motion: Chosen, times: Floats) -> float:
    """Return the largest speed of a motion at some times (t,) in s, as far as it is known beforehand, in m/s."""
    part, course = motion.part, motion.part.course(motion.params)
    if part.velocity is None:
        return 0.0 if part.start is None else float(np.linalg.norm(part.start(course)))
    return max(float(np.linalg.norm(part.velocity(course, float(time)))) for time in times)
