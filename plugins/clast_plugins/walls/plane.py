"""Plane: an infinite half-space, or a thin round plate."""

from __future__ import annotations

from math import inf, sqrt
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Direction, Length, Point
from clast.maths.vec3 import Vec, add, dot, norm, scale, sub
from clast.parts.params import Params
from clast.parts.wall import Nearest, Wall
from clast.plugins.registry import Registry


class Plane(Params):
    """A plane through a point; with a radius, a thin round plate about that point.

    The infinite plane is the face of a half-space: a particle behind it is pushed back to the front. A plate has two
    faces and a rim, and lets particles pass beside it.
    """

    point: Annotated[Point, Field(examples=[[0, 0, 0]], description="A point of the plane; the centre of a plate")]
    normal: Annotated[
        Direction, Field(examples=[[0, 0, 1]], description="Direction from the face towards the particles")
    ]
    radius: Annotated[Length | None, Field(gt=0, description="Radius of a finite plate; none: infinite")] = None


class Shape(NamedTuple):
    """Centre, unit normal, and plate radius (infinite for a plane) in m."""

    point: Vec
    normal: Vec
    radius: float


def shape(params: Plane) -> Shape:
    """Return the numbers of the plane."""
    length = norm(params.normal)
    return Shape(params.point, scale(1.0 / length, params.normal), inf if params.radius is None else params.radius)


def nearest(shape: Shape, x: Vec) -> Nearest:
    """Return distance and direction from x to the nearest point of the face, or of a plate's rim."""
    away = sub(x, shape.point)
    height = dot(away, shape.normal)
    if shape.radius == inf:
        return Nearest(height, scale(-1.0, shape.normal))
    outward = sub(away, scale(height, shape.normal))
    out = sqrt(dot(outward, outward))
    beyond = max(out - shape.radius, 0.0)
    to_rim = scale(-beyond / out if out > 0.0 else 0.0, outward)
    path = add(to_rim, scale(-height, shape.normal))
    distance = norm(path)
    if distance == 0.0:
        return Nearest(0.0, scale(-1.0, shape.normal))
    return Nearest(distance, scale(1.0 / distance, path))


def centre(params: Plane) -> Vec:
    """Return the point about which the moment is reported."""
    return params.point


def flat(params: Plane) -> bool:
    """Return whether it is infinite: a plate is touched from both faces and on its rim."""
    return params.radius is None


def mesh(params: Plane, size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return a disc of 48 triangles, of the plate's radius or of ``size``."""
    n = np.asarray(shape(params).normal)
    helper = np.eye(3)[np.argmin(np.abs(n))]
    e1 = np.cross(n, helper)
    e1 /= np.linalg.norm(e1)
    angle = 2.0 * np.pi * np.arange(48) / 48
    radius = size if params.radius is None else params.radius
    rim = np.outer(np.cos(angle), e1) + np.outer(np.sin(angle), np.cross(n, e1))
    points = np.asarray(params.point) + radius * np.vstack([np.zeros(3), rim])
    k = np.arange(48)
    return points, np.column_stack([np.zeros(48, np.int64), 1 + k, 1 + (k + 1) % 48])


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the plane."""
    registry.wall(
        "plane",
        Wall(
            summary="infinite plane, or a thin round plate",
            Params=Plane,
            Shape=Shape,
            shape=shape,
            nearest=nearest,
            centre=centre,
            mesh=mesh,
            flat=flat,
        ),
    )
