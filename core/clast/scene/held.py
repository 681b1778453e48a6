"""Held: whether something stands behind particles that are pushed, such as a bottom under a tube full of grains."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.maths.vec3 import ZERO, Vec
from clast.parts.motion import Pressed
from clast.scene.plan import wall_shapes
from clast.scene.scene import Scene

Floats = NDArray[np.float64]
ASKED = 64
"""Particles that are looked at, and steps taken on the way of each."""
TIMES = (0.0, *(10.0**k for k in range(-9, 4)))
"""When motions are asked for their velocity, in s: some begin at rest."""


def not_held(scene: Scene) -> list[str]:
    """Return a sentence for each push that more than half of the particles would follow for ever.

    Pushes are body forces and walls that move; what holds are walls, and the domain. Scenes
    without walls are left alone, and those with particles that nothing moves: on such ones others may rest.
    """
    if not scene.config.walls or scene.config.boundaries.domain is not None or scene.prescribed.any():
        return []
    chosen = np.unique(np.linspace(0, len(scene.radius) - 1, ASKED).astype(np.int64))
    told = []
    for name, way in _pushes(scene):
        free = sum(not _stopped(scene, int(k), way) for k in chosen)
        if free > 0.5 * len(chosen):
            told.append(
                f"nothing holds the particles against {name}: no wall lies behind them in the direction in "
                "which it goes. Add one, such as a bottom, or boundaries.domain"
            )
    return told


def _pushes(scene: Scene) -> Iterator[tuple[str, Floats]]:
    """Yield what pushes, and the unit vector along which it does."""
    for k, chosen in enumerate(scene.config.body_forces):
        numbers = chosen.part.numbers(chosen.params, scene.config.time.mass_scaling)
        pull = pull_of(chosen, numbers, tuple(scene.position[0].tolist()), ZERO, float(scene.radius[0]))
        if pull.any():
            yield f"body_forces.{k} ({chosen.name})", pull / np.linalg.norm(pull)
    for name, wall in scene.config.walls.items():
        way = np.zeros(3) if wall.motion is None else _direction(wall.motion)
        if way.any():
            yield f"walls.{name}", way / np.linalg.norm(way)


def pull_of(chosen: Chosen, numbers: Any, x: Vec, v: Vec, radius: float) -> Floats:
    """Return what a body force does to a particle with a velocity and no spin, as an acceleration or a force."""
    if chosen.part.acceleration is not None:
        return np.array(chosen.part.acceleration(numbers, x, v, 0.0))
    return np.array(chosen.part.load(numbers, x, v, ZERO, radius, 0.0)[0])


def _direction(motion: Chosen) -> Floats:
    """Return a velocity in m/s that a motion has at some time, as long as nothing presses on its wall."""
    course = motion.part.course(motion.params)
    free = Pressed(force=(0.0, 0.0, 0.0), mass=1.0, velocity=(0.0, 0.0, 0.0), span=1e-3)
    for time in TIMES:
        if motion.part.answer is not None:
            velocity = np.array(motion.part.answer(course, time, free))
        else:
            velocity = np.array(motion.part.velocity(course, time))
        if velocity.any():
            return velocity
    return np.zeros(3)


def _stopped(scene: Scene, particle: int, way: Floats) -> bool:
    """Tell whether a particle on its way meets a wall, be it that which pushes it: a vessel holds what is in it."""
    x, radius = scene.position[particle], float(scene.radius[particle])
    return any(_met(nearest, shape, x, way, radius) for nearest, shape in wall_shapes(scene))


def _met(nearest: Callable[..., Any], shape: Any, x: Floats, way: Floats, radius: float) -> bool:
    """Tell whether a sphere on its way touches a surface; it may always go as far as the surface is away."""
    for _ in range(ASKED):
        gap = nearest(shape, tuple(x.tolist())).distance - radius
        if gap <= 0.01 * radius:
            found = nearest(shape, tuple((x + 0.1 * radius * way).tolist())).distance - radius
            return bool(found < gap)  # one that only slides along it goes on
        x = x + gap * way
    return False
