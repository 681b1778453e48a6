"""Bodies: what is odd about walls that forces move."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from clast.config.beside import WallChoice
from clast.config.choice import Chosen
from clast.maths.rotation import IDENTITY
from clast.maths.vec3 import ZERO
from clast.parts.motion import Pushed
from clast.scene.scene import Scene
from clast.scene.turning import arm

TINY = 1e-30


def odd_bodies(scene: Scene) -> list[str]:
    """Return a sentence for each wall that answers to forces and passes through particles, or cannot be as heavy."""
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
    for motion in (stage.motion for stage in wall.stages if stage.motion.part.answer_spin is not None):
        if motion.part.inverse_mass is not None:
            mass, inertia = weighed(motion)
            most = mass * arm(wall) ** 2
            if inertia > 1.01 * most:
                yield (
                    f"one of its moments of inertia is {inertia:.3g} kg m2, and if all of its mass lay at its farthest "
                    f"place it would be {most:.3g} kg m2"
                )


def weighed(motion: Chosen) -> tuple[float, float]:
    """Return the mass in kg of a wall that turns as moments want, and its largest moment of inertia in kg m²."""
    course, axes = motion.part.course(motion.params), np.eye(3)
    per_mass, per_inertia = [], []
    for k in range(3):
        normal, lever = tuple(axes[k].tolist()), tuple(axes[k - 1].tolist())
        still, away = (
            motion.part.inverse_mass(course, Pushed(normal, place, IDENTITY, 1.0)) for place in (ZERO, lever)
        )
        per_mass.append(still)
        per_inertia.append(away - still)
    return 1.0 / max(*per_mass, TINY), max(1.0 / each if each > TINY else 0.0 for each in per_inertia)
