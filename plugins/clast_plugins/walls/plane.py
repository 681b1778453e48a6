"""Plane: the face of an infinite half-space."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Direction, Point
from clast.maths.vec3 import Vec, dot, norm, scale, sub
from clast.parts.params import Params
from clast.parts.wall import Nearest, Wall
from clast.plugins.registry import Registry
from clast_plugins.walls.round_mesh import disc_mesh


class Plane(Params):
    """The face of an infinite half-space: a particle behind it is pushed back to the front."""

    point: Annotated[Point, Field(examples=[[0, 0, 0]], description="A point of the plane")]
    normal: Annotated[
        Direction, Field(examples=[[0, 0, 1]], description="Direction from the face towards the particles")
    ]


class Shape(NamedTuple):
    """Point in m and unit normal."""

    point: Vec
    normal: Vec


def shape(params: Plane) -> Shape:
    """Return the numbers of the plane."""
    return Shape(params.point, scale(1.0 / norm(params.normal), params.normal))


def nearest(shape: Shape, x: Vec) -> Nearest:
    """Return distance and direction from x to the face.

    >>> nearest(Shape((0.0, 0.0, 1.0), (0.0, 0.0, 1.0)), (5.0, 5.0, 3.0))
    Nearest(distance=2.0, normal=(-0.0, -0.0, -1.0))
    """
    return Nearest(dot(sub(x, shape.point), shape.normal), scale(-1.0, shape.normal))


def centre(params: Plane) -> Vec:
    """Return the point about which the moment is reported."""
    return params.point


def flat(params: Plane) -> bool:
    """Return True: all its normals are one."""
    return True


def mesh(params: Plane, size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return a disc of triangles of the radius ``size``."""
    return disc_mesh(params.point, shape(params).normal, size)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the plane."""
    registry.wall(
        "plane",
        Wall(
            summary="infinite plane",
            Params=Plane,
            Shape=Shape,
            shape=shape,
            nearest=nearest,
            centre=centre,
            mesh=mesh,
            flat=flat,
        ),
    )
