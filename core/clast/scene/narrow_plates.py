"""Plates that are narrower than the walls around them: particles slip past."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.config.scene import SceneConfig
from clast.scene.compression import Gauge

Floats = NDArray[np.float64]
FAR = 4.0
"""How far infinite plates are drawn, in widths of what surrounds them."""
ON_AN_EDGE = 9


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
        gap = max(min(wall.distance(x) for wall in around) for x in _rim(points, gauge.axis))
        if gap > smallest:
            found.append(
                f"walls.{gauge.names[k]} leaves a gap of {1e3 * gap:.3g} mm to {names}: particles of "
                f"{1e3 * smallest:.3g} mm slip past it; make it wider, or infinite"
            )
    return found


def _rim(points: Floats, axis: Floats) -> Floats:
    """Return points spread over the outline (r, 3) of a plate that is given by points (p, 3), seen along an axis."""
    from scipy.spatial import ConvexHull

    across = np.linalg.svd(axis[None])[2][1:]
    edges = points[ConvexHull(points @ across.T).simplices]
    share = np.linspace(0.0, 1.0, ON_AN_EDGE)[:, None, None]
    return np.asarray(((1.0 - share) * edges[:, 0] + share * edges[:, 1]).reshape(-1, 3))
