"""Cylinder: an infinite tube, touched from inside or outside."""

from __future__ import annotations

from math import pi
from typing import Annotated, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Direction, Length, Point
from clast.maths.vec3 import ZERO, Vec, across, norm, scale, sub
from clast.parts.params import Params
from clast.parts.wall import Nearest, Wall
from clast.plugins.registry import Registry
from clast_plugins.walls.round_mesh import tube_mesh


class Cylinder(Params):
    """An infinitely long cylinder wall.

    Contacts count as contacts with a flat wall: the cylinder must be much larger than the particles.
    """

    point: Annotated[Point, Field(examples=[[0, 0, 0]], description="A point on the axis")]
    axis: Annotated[Direction, Field(examples=[[0, 0, 1]], description="Direction of the axis")]
    radius: Annotated[Length, Field(gt=0, examples=["10 mm"], description="Radius of the cylinder")]
    side: Annotated[Literal["inside", "outside"], Field(description="where the particles are")] = "inside"


class Shape(NamedTuple):
    """Point on the axis, unit axis, radius in m, and +1 for inside, −1 for outside."""

    point: Vec
    axis: Vec
    radius: float
    sign: float


def shape(params: Cylinder) -> Shape:
    """Return the numbers of the cylinder."""
    axis = scale(1.0 / norm(params.axis), params.axis)
    return Shape(params.point, axis, params.radius, 1.0 if params.side == "inside" else -1.0)


def nearest(shape: Shape, x: Vec) -> Nearest:
    """Return distance and direction from x to the surface."""
    outward = across(sub(x, shape.point), shape.axis)
    out = norm(outward)
    if out == 0.0:
        return Nearest(shape.sign * shape.radius, ZERO)
    return Nearest(shape.sign * (shape.radius - out), scale(shape.sign / out, outward))


def centre(params: Cylinder) -> Vec:
    """Return the point about which the moment is reported."""
    return params.point


def girth(params: Cylinder) -> float:
    """Return the circumference in m."""
    return 2.0 * pi * params.radius


def section(params: Cylinder) -> float:
    """Return the area of the cross-section in m²."""
    return pi * params.radius**2


def mesh(params: Cylinder, size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return a tube of 96 triangles, ``size`` long on either side of the point."""
    return tube_mesh(params.point, shape(params).axis, params.radius, size)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the cylinder."""
    registry.wall(
        "cylinder",
        Wall(
            summary="infinite cylinder, touched from inside or outside",
            Params=Cylinder,
            Shape=Shape,
            shape=shape,
            nearest=nearest,
            centre=centre,
            mesh=mesh,
            girth=girth,
            section=section,
        ),
    )
