"""Which particles are near which walls."""

from __future__ import annotations

from clast.engine.compiler import compiled, inlined
from clast.engine.state import Bytes, Floats, Particles, Walls
from clast.maths.vec3 import Vec

from .lanes import row
from .layout import INVERSE_MASS, RADIUS
from .slots import MANIFOLDS, WALLS, wall_nearest, wall_touches
from .wall_frames import seen_from_wall


@compiled
def near_walls(particles: Particles, walls: Walls, slack: Floats, wall_slack: float, near: Bytes) -> None:
    """Mark every particle that can come to touch a wall before lists go stale, where one of the two can be moved.

    Parameters
    ----------
    particles, walls : tables
    slack : (n,) float64
        How far each particle may move in m.
    wall_slack : float
        How far a wall may move in m.
    near : (w, n) uint8
        Set to 1 where a particle is near a wall.
    """
    if WALLS:
        for w in range(len(walls.shape_kind)):
            for k in range(len(particles.pose)):
                if particles.present[k] == 0 or not (walls.answers[w] or particles.body[k, INVERSE_MASS] > 0.0):
                    continue
                x = seen_from_wall(walls, w, row(particles.pose, k, 0))
                if reaches_wall(walls, w, x, particles.pose[k, RADIUS] + slack[k] + wall_slack):
                    near[w, k] = 1


@inlined
def reaches_wall(walls: Walls, w: int, x: Vec, reach: float) -> bool:
    """Tell whether a wall is nearer to x than ``reach``; one of many faces need not find the nearest."""
    if MANIFOLDS and walls.slots[w] > 1:
        return bool(wall_touches(walls, w, x, reach, walls.places) > 0)
    return bool(wall_nearest(walls, w, x).distance < reach)
