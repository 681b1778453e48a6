"""Which particles are near which walls."""

from __future__ import annotations

from clast.engine.compiler import compiled
from clast.engine.state import Bytes, Floats, Particles, Walls
from clast.maths.vec3 import sub

from .lanes import row
from .layout import INVERSE_MASS, RADIUS
from .slots import WALLS, wall_nearest


@compiled
def near_walls(particles: Particles, walls: Walls, slack: Floats, wall_slack: float, near: Bytes) -> None:
    """Mark every movable particle that can come to touch a wall before lists go stale.

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
                if particles.present[k] == 0 or particles.body[k, INVERSE_MASS] == 0.0:
                    continue
                x = sub(row(particles.pose, k, 0), row(walls.displacement, w, 0))
                found = wall_nearest(walls, w, x)
                if found.distance < particles.pose[k, RADIUS] + slack[k] + wall_slack:
                    near[w, k] = 1
