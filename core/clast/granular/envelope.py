"""Envelope of a grain: the convex hull of its primaries."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
CORE = 0.99
"""Share of the smallest radius by which hulls are grown that centres alone do not span."""
FIBONACCI = 60
"""Points on a sphere that stand for it where radii differ."""


def hull_volume(centre: Floats, radius: Floats) -> float:
    """Return the volume of the convex hull of spheres in m³.

    Equation: the hull of spheres is that of the centres grown by r to all sides, and V = V₀ + S₀ r + M₀ r² + 4/3 π r³
    with volume V₀, surface S₀ and integral mean curvature M₀ = ½ Σ L θ over the edges (length L, angle θ between the
    outward normals) of the hull of the centres.

    Where radii differ, r is 0.99 of the smallest one, and each sphere is first replaced by 60 points on a sphere of
    the radius left: a few per cent of the difference are missing. The same holds for fewer centres than span a body.

    Parameters
    ----------
    centre : (n, 3) float64
        In m; a grain of which a primary has left the domain (NaN) has no hull: then NaN is returned.
    radius : (n,) float64
        In m.

    Source: J. Steiner, Über parallele Flächen, Monatsberichte der Preussischen Akademie (1840), 114-118.

    Examples
    --------
    Eight unit spheres at the corners of a cube of 2: the cube, six slabs on its faces, quarter tubes on its edges,
    one sphere on its corners.

    >>> corners = np.array([[x, y, z] for x in (0.0, 2.0) for y in (0.0, 2.0) for z in (0.0, 2.0)])
    >>> round(hull_volume(corners, np.ones(8)) - (8 + 24 + 6 * np.pi + 4 / 3 * np.pi), 9)
    0.0
    """
    if not np.isfinite(centre).all():
        return float("nan")
    if len(radius) > 3 and np.ptp(radius) <= 1e-9 * radius.min() and _span_a_body(centre):
        return _grown(centre, float(radius.min()))
    core = CORE * float(radius.min())
    points = centre[:, None] + (radius - core)[:, None, None] * _directions()
    return _grown(points.reshape(-1, 3), core)


def _span_a_body(centre: Floats) -> bool:
    """Tell whether points lie neither on a line nor in a plane."""
    spread = np.linalg.svd(centre - centre.mean(axis=0), compute_uv=False)
    return bool(spread[2] > 1e-6 * spread[0])


def _grown(points: Floats, r: float) -> float:
    from scipy.spatial import ConvexHull

    hull = ConvexHull(points)
    normal = hull.equations[:, :3]
    angle = np.arccos(np.clip(np.einsum("fi,fki->fk", normal, normal[hull.neighbors]), -1.0, 1.0))
    corner = points[hull.simplices]
    # the edge between a facet and its k-th neighbour lies opposite to the k-th corner
    edge = np.linalg.norm(np.roll(corner, -1, axis=1) - np.roll(corner, -2, axis=1), axis=2)
    curvature = 0.25 * float(np.sum(edge * angle))  # every edge is there twice
    return float(hull.volume + hull.area * r + curvature * r**2 + 4.0 / 3.0 * np.pi * r**3)


def _directions() -> Floats:
    """Return points spread evenly over the unit sphere, (60, 3)."""
    k = np.arange(FIBONACCI)
    z, turn = 1.0 - (2.0 * k + 1.0) / FIBONACCI, np.pi * (1.0 + np.sqrt(5.0)) * k
    out = np.sqrt(1.0 - z**2)
    return np.column_stack([out * np.cos(turn), out * np.sin(turn), z])
