"""An ellipsoid as a room, and the distance of points inside from its surface."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from clast_plugins.generators.packing.room import Floats, random_points, squares

TINY = 1e-9
"""Share of the smallest semi-axis by which points keep off planes of symmetry, where the nearest may not be unique."""
CLOSE = 1e-14
"""Relative change at which the search for the nearest point ends."""
TRIES = 100


class Ellipsoid(NamedTuple):
    """An ellipsoid about the origin, its semi-axes along x, y and z."""

    x: float
    y: float
    z: float

    @property
    def volume(self) -> float:
        """Volume: 4/3 π a b c."""
        return 4.0 / 3.0 * math.pi * self.x * self.y * self.z

    @property
    def surface(self) -> float:
        """Surface, by the formula of K. Thomsen, which is right to 1.1 %.

        >>> math.isclose(Ellipsoid(2.0, 2.0, 2.0).surface, 16.0 * math.pi)
        True
        """
        p = 1.6075
        a, b, c = self.x**p, self.y**p, self.z**p
        return float(4.0 * math.pi * ((a * b + b * c + c * a) / 3.0) ** (1.0 / p))

    @property
    def inradius(self) -> float:
        """Radius of the largest sphere that has room."""
        return min(self)

    def per(self, length: float) -> Ellipsoid:
        """Return the room in another unit of length."""
        return Ellipsoid(self.x / length, self.y / length, self.z / length)

    def random(self, stream: np.random.Philox, count: int, margin: float) -> Floats:
        """Return ``count`` points (count, 3), uniform among those at least ``margin`` from the surface."""
        return random_points(stream, count, np.array(self) - margin, lambda x: self._holds(x, margin))

    def confine(self, position: Floats, margin: Floats) -> Floats:
        """Return centres (n, 3) moved to their margins (n,), straight away from the nearest point of the surface.

        Where the surface is more curved than a sphere of the margin, that is not far enough: such a centre then goes on
        towards the origin. The distance from the surface of a convex body is concave along this way, so the straight
        line between its two ends tells a step that is long enough.

        >>> outside_and_free = np.array([[0.0, 0.0, 2.0], [0.0, 0.0, 0.3]])
        >>> Ellipsoid(3.0, 2.0, 1.0).confine(outside_and_free, np.array([0.5, 0.5])).round(6)
        array([[0. , 0. , 0.5],
               [0. , 0. , 0.3]])
        """
        moved = position.copy()
        near = np.flatnonzero(~self._surely_holds(position, margin))
        if not len(near):
            return moved
        wanted = margin[near]
        foot = nearest(np.array(self), position[near])
        inward = -foot / np.array(self) ** 2
        inward /= np.sqrt(squares(inward))[:, None]
        free = _depth(np.array(self), position[near], foot) >= wanted
        moved[near] = np.where(free[:, None], position[near], foot + wanted[:, None] * inward)
        moved[near] = self._pulled_in(moved[near], wanted)
        return moved

    def _pulled_in(self, position: Floats, margin: Floats) -> Floats:
        """Return centres moved towards the origin as far as their margins still need."""
        depth = _depth(np.array(self), position, nearest(np.array(self), position))
        short = depth < margin * (1.0 - 1e-12)
        moved = position.copy()
        span = self.inradius - depth[short]
        moved[short] *= np.maximum((self.inradius - margin[short]) / span, 0.0)[:, None]
        return moved

    def _holds(self, position: Floats, margin: float) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        held = self._surely_holds(position, np.full(len(position), margin))
        rest = np.flatnonzero(~held)
        held[rest] = _depth(np.array(self), position[rest], nearest(np.array(self), position[rest])) >= margin
        return held

    def _surely_holds(self, position: Floats, margin: Floats) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        """Tell which points are so far inside that nothing need be searched: a lower bound of their distance."""
        share = np.sqrt(squares(position / np.array(self)))
        return np.asarray(self.inradius * (1.0 - share) >= margin)


def nearest(semi_axes: Floats, position: Floats) -> Floats:
    """Return the points of an ellipsoid's surface (n, 3) that are nearest to others.

    Equation: y_i = a_i² x_i/(s + a_i² − c²), with the largest root s of Σ (a_i x_i/(s + a_i² − c²))² = 1 and c the
    least of a_i, by Newton's steps from where the sum is above 1: it is convex there, so that they approach the root
    from one side.

    Parameters
    ----------
    semi_axes : (3,) float64
    position : (n, 3) float64
        Inside or outside.

    Source: D. Eberly (2013), Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid, Geometric Tools.

    >>> nearest(np.array([3.0, 2.0, 1.0]), np.array([[0.0, 0.0, 5.0], [4.0, 0.0, 0.0]])).round(6) + 0.0
    array([[0., 0., 1.],
           [3., 0., 0.]])
    """
    square = semi_axes**2
    size = np.maximum(np.abs(position), TINY * semi_axes.min())
    weighed, longer = semi_axes * size, square - square.min()
    s = (weighed - longer).max(axis=1)
    for _ in range(TRIES):
        below = s[:, None] + longer
        ratio = weighed / below
        step = 0.5 * (squares(ratio) - 1.0) / squares(ratio / np.sqrt(below))
        s = s + np.maximum(step, 0.0)
        if not (step > CLOSE * s).any():
            break
    return np.asarray(np.copysign(square * size / (s[:, None] + longer), position))


def _depth(semi_axes: Floats, position: Floats, foot: Floats) -> Floats:
    """Return how far inside points are whose nearest points of the surface are known; negative outside."""
    inside = squares(position / semi_axes) <= 1.0
    return np.asarray(np.where(inside, 1.0, -1.0) * np.sqrt(squares(position - foot)))
