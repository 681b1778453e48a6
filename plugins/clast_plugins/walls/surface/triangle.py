"""One triangle: its nearest point, by C. Ericson (2005), Real-Time Collision Detection, Sect. 5.1.5; boxes likewise."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.maths.vec3 import Vec, add, dot, norm, scale, sub

WIDTH = 12
"""Numbers of a triangle in a row: its first corner, the ways to the other two, and its unit normal."""


class Foot(NamedTuple):
    """Nearest point of a triangle: its distance in m, the unit vector towards it, and where it is."""

    distance: float
    normal: Vec
    point: Vec


def rows_of(triangles: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rows of triangles, (t, ``WIDTH``) from (t, 3, 3)."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    n = np.cross(b - a, c - a)
    return np.hstack([a, b - a, c - a, n / np.linalg.norm(n, axis=1)[:, None]])


def vector_at(rows: NDArray[np.float64], k: int) -> Vec:
    """Return three numbers in a row as a vector."""
    return (rows[k], rows[k + 1], rows[k + 2])


def outside(boxes: NDArray[np.float64], k: int, x: Vec) -> float:
    """Return the squared distance from x to a box in m², 0 inside."""
    found = 0.0
    for c in range(3):
        away = max(boxes[k + c] - x[c], x[c] - boxes[k + 3 + c], 0.0)
        found += away * away
    return found


def towards(path: Vec, x: Vec, n: Vec) -> Foot:
    """Return the foot at the end of a path from x; its normal where the path has no direction is that of the face."""
    distance = norm(path)
    if distance == 0.0:
        return Foot(0.0, scale(-1.0, n), x)
    return Foot(distance, scale(1.0 / distance, path), add(x, path))


def foot_on(rows: NDArray[np.float64], k: int, x: Vec) -> Foot:
    """Return the nearest point of the triangle whose row begins at k.

    >>> flat = rows_of(np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])).ravel()
    >>> tuple(map(float, foot_on(flat, 0, (0.25, 0.25, 2.0)).normal)), foot_on(flat, 0, (-3.0, -4.0, 0.0)).distance
    ((-0.0, -0.0, -1.0), 5.0)
    """
    b, c, n = vector_at(rows, k + 3), vector_at(rows, k + 6), vector_at(rows, k + 9)
    p = sub(x, vector_at(rows, k))
    d1, d2, bb, bc, cc = dot(b, p), dot(c, p), dot(b, b), dot(b, c), dot(c, c)
    d3, d4, d5, d6 = d1 - bb, d2 - bc, d1 - bc, d2 - cc
    va, vb, vc = d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2
    if d1 <= 0.0 and d2 <= 0.0:
        s, t = 0.0, 0.0
    elif d3 >= 0.0 and d4 <= d3:
        s, t = 1.0, 0.0
    elif d6 >= 0.0 and d5 <= d6:
        s, t = 0.0, 1.0
    elif vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        s, t = d1 / bb, 0.0
    elif vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        s, t = 0.0, d2 / cc
    elif va <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        t = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        s = 1.0 - t
    else:  # above the inside: the normal of the face is exact, whatever the size of the triangle
        return towards(scale(-dot(p, n), n), x, n)
    return towards(sub(add(scale(s, b), scale(t, c)), p), x, n)
