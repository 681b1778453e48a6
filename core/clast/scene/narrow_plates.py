"""Plates that are narrower than the walls around them: particles slip past."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from clast.config.beside import WallChoice
from clast.config.scene import SceneConfig
from clast.scene.compression import Gauge

Floats = NDArray[np.float64]
FAR = 4.0
"""How far infinite plates are drawn, in widths of what surrounds them."""
ON_AN_EDGE = 9
CLOSE = 1e-3


def narrow_plates(config: SceneConfig, smallest: float) -> list[str]:
    """Return a sentence for each plate of a compression past which particles fit along the walls around.

    Parameters
    ----------
    config : SceneConfig
    smallest : float
        Diameter of the smallest particle in m.
    """
    gauge = Gauge(config)
    if gauge.axis is None or gauge.side is None:
        return []
    around = [list(config.walls.values())[k] for k in gauge.side.walls]
    names = f"walls.{gauge.names[gauge.side.walls[0]]}" if len(around) == 1 else "the walls around"
    found = []
    for k in (gauge.upper, gauge.lower):
        plate = list(config.walls.values())[k].shape
        points = plate.part.mesh(plate.params, FAR * gauge.area**0.5)[0]
        ball = 2.0 * max(_room_beside(x, way, around) for x, way in _rim(points, gauge.axis))
        if ball > smallest:
            found.append(
                f"walls.{gauge.names[k]} leaves room for balls of {1e3 * ball:.3g} mm to {names}: particles of "
                f"{1e3 * smallest:.3g} mm slip past it; make it wider, or infinite"
            )
    return found


def _room_beside(x: Floats, way: Floats, around: list[WallChoice]) -> float:
    """Return the radius in m of the largest ball that touches a rim at x (3,), aside of it, and the walls around."""
    low, high = 0.0, max(min(wall.distance(x) for wall in around), 0.0)
    while high - low > CLOSE * high:
        middle = 0.5 * (low + high)
        if min(wall.distance(x + middle * way) for wall in around) >= middle:
            low = middle
        else:
            high = middle
    return low


def _rim(points: Floats, axis: Floats) -> Iterator[tuple[Floats, Floats]]:
    """Yield points spread over the outline of a plate, seen along an axis, and the ways out of it; (p, 3) points."""
    from scipy.spatial import ConvexHull

    across = np.linalg.svd(axis[None])[2][1:]
    hull = ConvexHull(points @ across.T)
    for edge, equation in zip(hull.simplices, hull.equations, strict=True):
        first, second = points[edge]
        for share in np.linspace(0.0, 1.0, ON_AN_EDGE).tolist():
            yield (1.0 - share) * first + share * second, equation[:2] @ across
