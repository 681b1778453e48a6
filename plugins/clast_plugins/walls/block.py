"""Block: a solid box that particles run into, with faces, edges and corners."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.problems import wrong
from clast.config.quantities import Point
from clast.maths.vec3 import Vec, norm, scale
from clast.parts.params import Params
from clast.parts.wall import Nearest, Wall
from clast.plugins.registry import Registry


class Block(Params):
    r"""A solid box along the axes, touched from outside.

    Equation
    --------
    Outside: the nearest point has the coordinates of the particle's centre, each limited to the box. Inside: the
    nearest of the six faces, at a negative distance.

    Limits
    ------
    One contact a particle: exact, because a box is convex. Contacts count as contacts with a flat wall, at edges and
    corners too. For a box that holds particles take six planes: in its corners a particle touches three of them.

    Source
    ------
    C. Ericson (2005), Real-Time Collision Detection, Sect. 5.1.3: closest point on an axis-aligned box.
    """

    lower: Annotated[Point, Field(examples=[[0, 0, 0]], description="Corner with the smallest coordinates")]
    upper: Annotated[Point, Field(examples=[["10 mm", "10 mm", "5 mm"]], description="Corner with the largest")]

    @model_validator(mode="after")
    def _has_a_volume(self) -> Block:
        for axis, low, high in zip("xyz", self.lower, self.upper, strict=True):
            if not low < high:
                raise wrong("upper", f"upper must be above lower along {axis}; given {high:g} m and {low:g} m")
        return self


class Shape(NamedTuple):
    """Both corners in m."""

    lower: Vec
    upper: Vec


def shape(params: Block) -> Shape:
    """Return the numbers of the block."""
    return Shape(params.lower, params.upper)


def nearest(shape: Shape, x: Vec) -> Nearest:
    """Return distance and direction from x to the surface.

    >>> nearest(Shape((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)), (0.5, 0.5, 3.0))
    Nearest(distance=2.0, normal=(0.0, 0.0, -1.0))
    """
    low, high = shape.lower, shape.upper
    path = (
        min(max(x[0], low[0]), high[0]) - x[0],
        min(max(x[1], low[1]), high[1]) - x[1],
        min(max(x[2], low[2]), high[2]) - x[2],
    )
    distance = norm(path)
    if distance > 0.0:
        return Nearest(distance, scale(1.0 / distance, path))
    return from_inside(low, high, x)


def from_inside(low: Vec, high: Vec, x: Vec) -> Nearest:
    """Return the nearest face, its depth as a negative distance, and the normal that pushes out through it."""
    depth, normal = x[0] - low[0], (1.0, 0.0, 0.0)
    if high[0] - x[0] < depth:
        depth, normal = high[0] - x[0], (-1.0, 0.0, 0.0)
    if x[1] - low[1] < depth:
        depth, normal = x[1] - low[1], (0.0, 1.0, 0.0)
    if high[1] - x[1] < depth:
        depth, normal = high[1] - x[1], (0.0, -1.0, 0.0)
    if x[2] - low[2] < depth:
        depth, normal = x[2] - low[2], (0.0, 0.0, 1.0)
    if high[2] - x[2] < depth:
        depth, normal = high[2] - x[2], (0.0, 0.0, -1.0)
    return Nearest(-depth, normal)


def centre(params: Block) -> Vec:
    """Return the middle, about which the moment is reported."""
    low, high = params.lower, params.upper
    return (0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2]))


def mesh(params: Block, size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return the eight corners and twelve triangles."""
    corner = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    points = np.where(corner == 1, np.array(params.upper), np.array(params.lower))
    faces = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return points, np.vstack([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]]).astype(np.int64)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the block."""
    registry.wall(
        "block",
        Wall(
            summary="solid box along the axes, touched from outside",
            Params=Block,
            Shape=Shape,
            shape=shape,
            nearest=nearest,
            centre=centre,
            mesh=mesh,
        ),
    )
