"""Where particles touch walls, asked from Python: one by one, or compiled where it takes long and they are many."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.parts.wall import Wall

Floats = NDArray[np.float64]
FEW = 100
"""Questions up to which compiling takes longer than asking."""


class Feet(NamedTuple):
    """Places where points are near a surface: which point, the distance in m, and the unit vector towards it.

    Attributes
    ----------
    point : (f,) int64
    distance : (f,) float64
    normal : (f, 3) float64
    """

    point: NDArray[np.int64]
    distance: Floats
    normal: Floats


def feet(wall: Wall, params: Any, points: Floats, reach: Floats) -> Feet:
    """Return all places of a wall that are nearer to points (n, 3), in its own frame, than their reach (n,), in m."""
    shape = wall.shape(params)
    most = wall.slots(params)
    found = np.full((len(points), most, 4), np.inf)
    if wall.touches is None or most == 1:
        for k, x in enumerate(points.tolist()):
            near = wall.nearest(shape, tuple(x))
            found[k, 0] = near.distance, *near.normal
    else:
        loop = _plain(wall.touches) if len(points) <= FEW else _compiled(wall.touches)
        loop(shape, points, reach, found)
    point, slot = np.nonzero(found[:, :, 0] < reach[:, None])
    return Feet(point, found[point, slot, 0], found[point, slot, 1:])


def _plain(touches: Callable[..., int]) -> Callable[..., None]:
    def loop(shape: Any, points: Floats, reach: Floats, found: NDArray[np.float64]) -> None:
        for k in range(len(points)):
            count = touches(shape, (points[k, 0], points[k, 1], points[k, 2]), reach[k], found[k])
            for s in range(count, found.shape[1]):
                found[k, s, 0] = np.inf

    return loop


@cache
def _compiled(touches: Callable[..., int]) -> Callable[..., None]:
    from numba import njit

    from clast.engine.assemble import let_compiled_code_call
    from clast.engine.compiler import STRICT

    let_compiled_code_call([touches])
    compiled: Callable[..., None] = njit(**STRICT)(_plain(touches))
    return compiled
