"""Which particles can touch which walls, without asking every wall about every particle."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.engine.wall_feet import feet
from clast.engine.wall_frames import WallFrames
from clast.scene.scene import Scene

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
WIDTH = 6.0
"""Width of the cells in which particles are asked about together, in largest radii."""
FEW = 64


def near_walls(scene: Scene, position: Floats, frames: WallFrames) -> Integers:
    """Return the rows (p, 2), wall and particle in rising order, of all particles that may touch a wall.

    The distances of two points to a surface differ by no more than the points are apart: so one question, at the middle
    of a cell, answers for all particles in it that are far away.

    Parameters
    ----------
    position : (n, 3) float64
        Centres in m.
    frames : WallFrames
        Where the walls are.
    """
    largest = float(scene.radius.max())
    walls = list(scene.config.walls.values())
    if len(position) <= FEW:
        return np.argwhere(np.ones((len(walls), len(position)), bool))
    width = WIDTH * largest
    cell = np.floor((position - position.min(axis=0)) / width)
    place, member = np.unique(cell, axis=0, return_inverse=True)
    middle = position.min(axis=0) + width * (place + 0.5)
    reach = np.full(len(middle), largest + 0.5 * np.sqrt(3.0) * width * (1.0 + 1e-9))
    rows = []
    for w, wall in enumerate(walls):
        near = np.zeros(len(middle), bool)
        near[feet(wall.shape.part, wall.shape.params, frames.seen(w, middle), reach).point] = True
        here = np.nonzero(near[member.ravel()])[0]
        rows.append(np.column_stack([np.full(len(here), w), here]))
    return np.concatenate([np.zeros((0, 2), np.int64), *rows])
