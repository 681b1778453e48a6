"""Swift walls: walls that go or turn so far in one step that contacts cannot follow them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.maths.vec3 import ZERO
from clast.scene.turning import spins
from clast.soundness.motion import MOST_TURN, MOST_WAY

Floats = NDArray[np.float64]
LOOKS = 500
"""How often a motion is asked for its velocity."""


def swift_walls(config: SceneConfig, radius: float, step: float, steps: int) -> list[str]:
    """Return a sentence for each wall that is known to go or turn farther in a step than contacts can follow.

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
        motions = [stage.motion for stage in wall.stages]
        turn = step * max([0.0, *(_longest(spins_of(each)) for each in motions)])
        way = step * max([0.0, *(_longest(velocities_of(each, times)) for each in motions)])
        if turn > MOST_TURN:
            text = (
                f"it turns by up to {turn:.2g} rad in a step of {step:.3g} s, where {MOST_TURN:g} is the most: turn it "
                "more slowly, or take a smaller time.step"
            )
            told.append(config.remark(("walls", name), text))
        if way > MOST_WAY * radius:
            text = (
                f"it goes up to {way:.3g} m in a step of {step:.3g} s, {way / radius:.2g} times the smallest radius: "
                "it passes through particles. Slow it down, or take a time.step below "
                f"{MOST_WAY * radius / way * step:.2g} s"
            )
            told.append(config.remark(("walls", name), text))
    return told


def _longest(vectors: Floats) -> float:
    return float(np.linalg.norm(vectors, axis=1).max())


def spins_of(motion: Chosen) -> Floats:
    """Return angular velocities of a motion in rad/s, (t, 3), as far as they are known beforehand."""
    part = motion.part
    if part.answer_spin is None:
        return spins(motion)
    start = ZERO if part.start_spin is None else part.start_spin(part.course(motion.params))
    return np.array([start])


def velocities_of(motion: Chosen, times: Floats) -> Floats:
    """Return velocities of a motion at times (t,) in s, as far as they are known beforehand, (v, 3) in m/s."""
    part, course = motion.part, motion.part.course(motion.params)
    if part.velocity is None:
        return np.array([ZERO if part.start is None else part.start(course)])
    return np.array([part.velocity(course, time) for time in times.tolist()])
