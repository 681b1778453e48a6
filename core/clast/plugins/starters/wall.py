"""Starter: a half-space below a level."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Length
from clast.maths.vec3 import Vec
from clast.parts.params import Params
from clast.parts.wall import Nearest, Wall
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """A floor: everything below a level is solid.

    Limits
    ------
    Level and infinite.

    Source
    ------
    Plain geometry.
    """

    level: Annotated[Length, Field(examples=["0 mm"], description="Height of the floor along z")]


class Shape(NamedTuple):
    """Height in m."""

    level: float


def shape(params: Starter) -> Shape:
    """Return the numbers that the compiled loop needs."""
    return Shape(params.level)


def nearest(floor: Shape, x: Vec) -> Nearest:
    """Return distance and direction of the nearest point, from a centre x in the wall's own frame."""
    return Nearest(x[2] - floor.level, (0.0, 0.0, -1.0))


def centre(params: Starter) -> Vec:
    """Return the point about which the wall's moment is told."""
    return (0.0, 0.0, params.level)


def mesh(params: Starter, size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return what pictures show of it, no larger than ``size`` in m: points and triangles."""
    h = 0.5 * size
    corners = [[-h, -h], [h, -h], [h, h], [-h, h]]
    points = np.array([[x, y, params.level] for x, y in corners])
    return points, np.array([[0, 1, 2], [0, 2, 3]])


def flat(params: Starter) -> bool:
    """Tell that all its normals are one."""
    return True


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the wall."""
    registry.wall("starter", Wall("a level floor", Starter, Shape, shape, nearest, centre, mesh, flat))
