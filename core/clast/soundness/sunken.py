"""Sunken walls: walls that stand inside particles which nothing moves, as forces begin to move them."""

from __future__ import annotations

import numpy as np

from clast.engine.kernels.layout import RADIUS, X
from clast.engine.state import World
from clast.engine.wall_feet import feet
from clast.engine.wall_frames import now
from clast.scene.scene import Scene


def sunken(scene: Scene, world: World, w: int) -> str | None:
    """Return which held particle wall w stands in, farther than contacts may begin with: it would be shot out.

    A wall that is driven passes through particles that are fixed or prescribed.
    """
    if scene.config.contacts is None or not scene.prescribed.any():
        return None
    wall = list(scene.config.walls.values())[w]
    held = np.nonzero(scene.prescribed & (world.particles.present != 0))[0]
    radius = world.particles.pose[held, RADIUS]
    seen = now(world.walls).seen(w, world.particles.pose[held, X : X + 3])
    found = feet(wall.shape.part, wall.shape.params, seen, radius)
    share = 1.0 - found.distance / radius[found.point]
    if not len(share) or share.max() <= scene.config.contacts.start_overlap:
        return None
    k = int(np.argmax(share))
    return f"{share[k]:.2g} of its radius inside particle {held[found.point[k]]}, which nothing moves"
