"""Which particles are near which walls."""

from __future__ import annotations

from clast.engine.compiler import compiled
from clast.engine.state import Bytes, Particles, Walls
from clast.maths.vec3 import sub

from .layout import INVERSE_MASS, RADIUS
from .slots import WALLS, wall_nearest
from .wall_sweep import row


@compiled
def near_walls(particles: Particles, walls: Walls, skin: float, near: Bytes) -> None:
    """Mark every movable particle whose surface is closer to a wall than the skin.

    Parameters
    ----------
    particles, walls : tables
    skin : float
        m.
    near : (w, n) uint8
        Set to 1 where a particle is near a wall.
    """
    if WALLS:
        for w in range(len(walls.shape_kind)):
            for k in range(len(particles.pose)):
                if particles.present[k] == 0 or particles.twist[k, INVERSE_MASS] == 0.0:
                    continue
                x = sub(row(particles.pose, k, 0), row(walls.displacement, w, 0))
                found = wall_nearest(walls.shape_kind[w], walls.shape[w], x)
                if found.distance < particles.pose[k, RADIUS] + skin:
                    near[w, k] = 1
