"""Triangles of round walls, for pictures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.maths.vec3 import Vec

Floats = NDArray[np.float64]
CORNERS = 48


def ring(axis: Vec) -> Floats:
    """Return corners on the unit circle across a unit axis, (48, 3)."""
    a = np.asarray(axis)
    e1 = np.cross(a, np.eye(3)[np.argmin(np.abs(a))])
    e1 /= np.linalg.norm(e1)
    angle = 2.0 * np.pi * np.arange(CORNERS) / CORNERS
    return np.asarray(np.outer(np.cos(angle), e1) + np.outer(np.sin(angle), np.cross(a, e1)))


def disc_mesh(centre: Vec, normal: Vec, radius: float) -> tuple[Floats, NDArray[np.int64]]:
    """Return points (49, 3) in m and triangles (48, 3) of a disc."""
    points = np.asarray(centre) + radius * np.vstack([np.zeros(3), ring(normal)])
    k = np.arange(CORNERS)
    return points, np.column_stack([np.zeros(CORNERS, np.int64), 1 + k, 1 + (k + 1) % CORNERS])


def tube_mesh(centre: Vec, axis: Vec, radius: float, length: float) -> tuple[Floats, NDArray[np.int64]]:
    """Return points (96, 3) in m and triangles (96, 3) of a tube, ``length`` m long on either side of its centre."""
    round_it = np.asarray(centre) + radius * ring(axis)
    points = np.vstack([round_it - length * np.asarray(axis), round_it + length * np.asarray(axis)])
    k, after = np.arange(CORNERS), (np.arange(CORNERS) + 1) % CORNERS
    return points, np.vstack(
        [np.column_stack([k, after, k + CORNERS]), np.column_stack([after, after + CORNERS, k + CORNERS])]
    )
