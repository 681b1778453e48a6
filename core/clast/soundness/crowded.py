"""Crowded: particles that touch a wall in more places than their contacts with it have room for."""

from __future__ import annotations

import numpy as np

from clast.engine.state import World
from clast.scene.scene import Scene


def crowded(world: World, scene: Scene) -> str | None:
    """Return which wall was touched in more places than it keeps contacts for, so that forces are missing."""
    walls = np.flatnonzero(world.walls.crowded)
    if not len(walls):
        return None
    name = list(scene.config.walls)[int(walls[0])]
    return (
        f"a particle touches walls.{name} in more than {int(world.walls.slots[walls[0]])} places, and others would "
        f"push nothing; raise walls.{name}.contacts, or make the surface coarser there"
    )
