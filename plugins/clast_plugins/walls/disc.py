"""Disc: a thin round plate."""

from __future__ import annotations

from math import sqrt
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
from clast_plugins.walls.round_mesh import disc_mesh


class Disc(Params):
    r"""A round plate without thickness.

    Equation
    --------
    The nearest point is that of the face, x − h n, or where this lies beyond the radius, that of the rim.

    Symbols
    -------
    h : height of the particle's centre over the plane of the disc in m; n : ``normal``, of length 1

    Limits
    ------
    It has two faces and a rim, and lets particles pass beside it: what is pressed through it stays behind it. Contacts
    at the rim count as contacts with a flat wall, too. For a piston in a tube a plane is the better choice.

    Source
    ------
    C. Ericson (2005), Real-Time Collision Detection, Sect. 5.1: closest points on flat shapes.
    """

    point: Annotated[Point, Field(examples=[[0, 0, 0]], description="Centre of the disc")]
    normal: Annotated[Direction, Field(examples=[[0, 0, 1]], description="Direction across the disc")]
    radius: Annotated[Length, Field(gt=0, examples=["5 mm"], description="Radius of the disc")]


class Shape(NamedTuple):
    """Centre, unit normal, and radius in m."""

    point: Vec
    normal: Vec
    radius: float


def shape(params: Disc) -> Shape:
    """Return the numbers of the disc."""
    return Shape(params.point, scale(1.0 / norm(params.normal), params.normal), params.radius)


def nearest(shape: Shape, x: Vec) -> Nearest:
    """Return distance and direction from x to the nearest point of a face or of the rim.

    >>> nearest(Shape((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 1.0), (4.0, 0.0, 4.0)).distance
    5.0
    """
    away = sub(x, shape.point)
    height = dot(away, shape.normal)
    outward = sub(away, scale(height, shape.normal))
    out = sqrt(dot(outward, outward))
    beyond = max(out - shape.radius, 0.0)
    to_rim = scale(-beyond / out if out > 0.0 else 0.0, outward)
    path = add(to_rim, scale(-height, shape.normal))
    distance = norm(path)
    if distance == 0.0:
        return Nearest(0.0, scale(-1.0, shape.normal))
    return Nearest(distance, scale(1.0 / distance, path))


def centre(params: Disc) -> Vec:
    """Return the point about which the moment is reported."""
    return params.point


def mesh(params: Disc, size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return the disc in triangles."""
    return disc_mesh(params.point, shape(params).normal, params.radius)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the disc."""
    registry.wall(
        "disc",
        Wall(
            summary="thin round plate, touched from both faces and on its rim",
            Params=Disc,
            Shape=Shape,
            shape=shape,
            nearest=nearest,
            centre=centre,
            mesh=mesh,
        ),
    )
