"""The room that a packing fills: what every shape of it must offer, and a ball, perhaps cut by two planes."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from clast.scene.packing_report import cut_sphere_surface, cut_sphere_volume

Floats = NDArray[np.float64]


class Room(Protocol):
    """A closed body about the origin that spheres are packed into, each wholly inside.

    A sphere of radius r is inside where its centre lies at least r from the surface: its *margin*.
    """

    @property
    def volume(self) -> float:
        """Volume, in cubes of the room's unit of length."""

    @property
    def surface(self) -> float:
        """Surface, in squares of the room's unit of length."""

    @property
    def inradius(self) -> float:
        """Radius of the largest sphere that has room."""

    def per(self, length: float) -> Room:
        """Return the room in another unit of length."""

    def random(self, stream: np.random.Philox, count: int, margin: float) -> Floats:
        """Return ``count`` points (count, 3), uniform among those at least ``margin`` from the surface."""

    def confine(self, position: Floats, margin: Floats) -> Floats:
        """Return centres (n, 3) moved to where each keeps its margin (n,)."""


class CutBall(NamedTuple):
    """A ball about the origin between two planes at ``z = ±half_height``."""

    radius: float
    half_height: float = math.inf

    @property
    def volume(self) -> float:
        """Volume of the ball between the planes."""
        return cut_sphere_volume(2.0 * self.radius, 2.0 * self.half_height)

    @property
    def surface(self) -> float:
        """Surface of the ball between the planes, with the two cuts."""
        return cut_sphere_surface(2.0 * self.radius, 2.0 * self.half_height)

    @property
    def inradius(self) -> float:
        """Radius of the largest sphere that has room."""
        return min(self)

    def per(self, length: float) -> CutBall:
        """Return the room in another unit of length."""
        return CutBall(self.radius / length, self.half_height / length)

    def random(self, stream: np.random.Philox, count: int, margin: float) -> Floats:
        """Return ``count`` points (count, 3), uniform among those at least ``margin`` from the surface."""
        radius, half_height = self.radius - margin, self.half_height - margin
        flat = min(1.0, half_height / radius if radius else 1.0)
        inside = random_points(stream, count, np.array([1.0, 1.0, flat]), lambda x: squares(x) <= 1.0)
        return inside * radius

    def confine(self, position: Floats, margin: Floats) -> Floats:
        """Return centres (n, 3) moved onto the planes first, then radially onto the ball.

        Examples
        --------
        >>> CutBall(2.5, 1.5).confine(np.array([[0.0, 0.0, 9.0], [3.0, 0.0, 0.0]]), np.array([0.5, 0.5]))
        array([[0., 0., 1.],
               [2., 0., 0.]])
        """
        moved = position.copy()
        half_height, radius = self.half_height - margin, self.radius - margin
        np.clip(moved[:, 2], -half_height, half_height, out=moved[:, 2])
        distance = np.sqrt(squares(moved))
        outside = distance > radius
        moved[outside] *= (radius[outside] / distance[outside])[:, None]
        return moved


def squares(position: Floats) -> Floats:
    """Return the squared distance (n,) of points from the origin; the sum has one order on every machine."""
    return np.asarray(position[:, 0] ** 2 + position[:, 1] ** 2 + position[:, 2] ** 2)


def uniforms(stream: np.random.Philox, count: int) -> Floats:
    """Return ``count`` rows of three numbers, uniform in [-1, 1).

    Made from raw bits: numpy promises to keep these over its versions, but not its distributions.

    >>> bool(np.all(np.abs(uniforms(np.random.Philox(1), 100)) <= 1.0))
    True
    """
    bits = np.asarray(stream.random_raw(3 * count), np.uint64)
    return np.asarray((bits >> np.uint64(11)) * 2.0**-52 - 1.0, np.float64).reshape(count, 3)


def random_points(
    stream: np.random.Philox, count: int, half_edges: Floats, inside: Callable[[Floats], NDArray[np.bool_]]
) -> Floats:
    """Return ``count`` points (count, 3), uniform where ``inside`` says so, within a box about the origin.

    Parameters
    ----------
    half_edges : (3,) float64
        Of a box around all that is inside.
    """
    kept = np.empty((0, 3))
    while len(kept) < count:
        trial = uniforms(stream, 2 * count) * half_edges
        kept = np.vstack([kept, trial[inside(trial)]])
    return kept[:count]
