"""Walls that turn: about which axes, and how far they reach from their pivot."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.config.beside import WallChoice
from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.maths.vec3 import ZERO

TIMES = (0.0, 1e-6, 1e-3, 0.1, 1.0, 1e3)
"""Times in s at which motions are asked how they turn."""
SIZES = (1.0, 2.0)
"""Sizes in m to which endless walls are drawn, to tell them from others."""


def spins(motion: Chosen) -> NDArray[np.float64]:
    """Return the angular velocities of a motion at several times, (t, 3) in rad/s; zeros where it does not turn.

    A wall that turns as moments want may do so about any axis: 1 rad/s about each is told.
    """
    if motion.part.answer_spin is not None:
        return np.eye(3)
    if motion.part.spin is None:
        return np.zeros((len(TIMES), 3))
    course = motion.part.course(motion.params)
    return np.array([motion.part.spin(course, time) for time in TIMES])


def arm(wall: WallChoice) -> float:
    """Return how far from the point about which it turns a wall reaches, in m; infinite where it is endless."""
    near, far = (_farthest(wall, size) for size in SIZES)
    return near if near == far else np.inf


def _farthest(wall: WallChoice, size: float) -> float:
    points, _ = wall.shape.part.mesh(wall.shape.params, size)
    return float(np.linalg.norm(points - np.array(wall.pivot or ZERO), axis=1).max())


def refuse_endless_bodies(config: SceneConfig) -> None:
    """Refuse walls without an end that are to turn as moments want.

    Raises
    ------
    ConfigError
    """
    for name, wall in config.walls.items():
        turning = any(stage.motion.part.answer_spin is not None for stage in wall.stages)
        if turning and not np.isfinite(arm(wall)):
            raise config.problem(
                ("walls", name),
                f"a {wall.shape.name!r} has no end, so it has no centre of mass to turn about; take a shape that ends, "
                "such as a disc, a block, a sphere or a mesh, or the motion 'free'",
            )
