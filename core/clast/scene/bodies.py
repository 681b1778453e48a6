"""Bodies: what is odd about walls that forces move."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from clast.config.beside import WallChoice
from clast.scene.scene import Scene


def odd_bodies(scene: Scene) -> list[str]:
    """Return a sentence for each wall that answers to forces but passes through particles, or turns about far away."""
    config = scene.config
    return [
        config.remark(("walls", name), text) for name, wall in config.walls.items() for text in _oddities(scene, wall)
    ]


def _oddities(scene: Scene, wall: WallChoice) -> Iterator[str]:
    held = int(scene.prescribed.sum())
    for motion in (stage.motion for stage in wall.stages):
        if held and scene.config.contacts is not None and motion.part.answer and motion.part.inverse_mass is None:
            yield (
                f"{held} particles are fixed or have a prescribed velocity, and the motion {motion.name!r} does not "
                "say how it gives way to a push (inverse_mass): the wall passes through them"
            )
    if wall.pivot is not None and any(stage.motion.part.answer is not None for stage in wall.stages):
        points, _ = wall.shape.part.mesh(wall.shape.params, 1.0)
        low, high = points.min(axis=0), points.max(axis=0)
        away = np.linalg.norm(np.maximum(np.maximum(low - wall.pivot, np.asarray(wall.pivot) - high), 0.0))
        size = np.linalg.norm(high - low)
        if away > size:
            yield f"its centre of mass lies {away:.3g} m away from its shape, which is {size:.3g} m long"
