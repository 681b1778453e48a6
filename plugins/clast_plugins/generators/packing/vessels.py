"""Rooms with straight sides: a box, one that repeats itself, and an upright tube."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from clast_plugins.generators.packing.room import Floats, random_points, uniforms


class Box(NamedTuple):
    """A box about the origin along the axes, by half its edges."""

    x: float
    y: float
    z: float

    @property
    def volume(self) -> float:
        """Volume of the box."""
        return 8.0 * self.x * self.y * self.z

    @property
    def surface(self) -> float:
        """Surface of its six sides."""
        return 8.0 * (self.x * self.y + self.y * self.z + self.z * self.x)

    @property
    def inradius(self) -> float:
        """Radius of the largest sphere that has room."""
        return min(self)

    def per(self, length: float) -> Box:
        """Return the room in another unit of length."""
        return Box(self.x / length, self.y / length, self.z / length)

    def random(self, stream: np.random.Philox, count: int, margin: float) -> Floats:
        """Return ``count`` points (count, 3), uniform among those at least ``margin`` from the surface."""
        return uniforms(stream, count) * (np.array(self) - margin)

    def confine(self, position: Floats, margin: Floats) -> Floats:
        """Return centres (n, 3) moved straight to their margins (n,).

        >>> Box(2.0, 2.0, 1.0).confine(np.array([[0.0, 3.0, -1.0]]), np.array([0.5]))
        array([[ 0. ,  1.5, -0.5]])
        """
        free = np.array(self) - margin[:, None]
        return np.clip(position, -free, free)


class Cell(NamedTuple):
    """A box about the origin, by half its edges, that has no walls in the directions in which it repeats itself."""

    half: tuple[float, float, float]
    closed: tuple[bool, bool, bool]

    @property
    def volume(self) -> float:
        """Volume of the box."""
        return Box(*self.half).volume

    @property
    def surface(self) -> float:
        """Surface of the sides that are walls.

        >>> Cell((1.0, 2.0, 3.0), (False, False, True)).surface
        16.0
        """
        return sum(self.volume / half for half, closed in zip(self.half, self.closed, strict=True) if closed)

    @property
    def inradius(self) -> float:
        """Radius of the largest sphere that has room between the walls."""
        return min((half for half, closed in zip(self.half, self.closed, strict=True) if closed), default=math.inf)

    def per(self, length: float) -> Cell:
        """Return the room in another unit of length."""
        x, y, z = self.half
        return Cell((x / length, y / length, z / length), self.closed)

    def random(self, stream: np.random.Philox, count: int, margin: float) -> Floats:
        """Return ``count`` points (count, 3), uniform among those at least ``margin`` from the walls."""
        return uniforms(stream, count) * (np.array(self.half) - margin * np.array(self.closed))

    def confine(self, position: Floats, margin: Floats) -> Floats:
        """Return centres (n, 3) moved straight to their margins (n,) from the walls.

        >>> Cell((2.0, 2.0, 1.0), (False, True, True)).confine(np.array([[9.0, 3.0, -1.0]]), np.array([0.5]))
        array([[ 9. ,  1.5, -0.5]])
        """
        free = np.where(self.closed, np.array(self.half) - margin[:, None], np.inf)
        return np.clip(position, -free, free)


class Tube(NamedTuple):
    """A cylinder about the z axis between ``z = ±half_height``."""

    radius: float
    half_height: float

    @property
    def volume(self) -> float:
        """Volume of the tube."""
        return 2.0 * math.pi * self.radius**2 * self.half_height

    @property
    def surface(self) -> float:
        """Surface, with both ends."""
        return 2.0 * math.pi * self.radius * (self.radius + 2.0 * self.half_height)

    @property
    def inradius(self) -> float:
        """Radius of the largest sphere that has room."""
        return min(self)

    def per(self, length: float) -> Tube:
        """Return the room in another unit of length."""
        return Tube(self.radius / length, self.half_height / length)

    def random(self, stream: np.random.Philox, count: int, margin: float) -> Floats:
        """Return ``count`` points (count, 3), uniform among those at least ``margin`` from the surface."""
        radius = self.radius - margin
        half_edges = np.array([radius, radius, self.half_height - margin])
        return random_points(stream, count, half_edges, lambda x: x[:, 0] ** 2 + x[:, 1] ** 2 <= radius**2)

    def confine(self, position: Floats, margin: Floats) -> Floats:
        """Return centres (n, 3) moved straight to their margins (n,) from the ends and from the side.

        >>> Tube(2.0, 1.0).confine(np.array([[0.0, 3.0, -1.0]]), np.array([0.5]))
        array([[ 0. ,  1.5, -0.5]])
        """
        moved = position.copy()
        half_height, radius = self.half_height - margin, self.radius - margin
        np.clip(moved[:, 2], -half_height, half_height, out=moved[:, 2])
        distance = np.sqrt(moved[:, 0] ** 2 + moved[:, 1] ** 2)
        outside = distance > radius
        moved[outside, :2] *= (radius[outside] / distance[outside])[:, None]
        return moved
