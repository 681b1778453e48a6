"""Sphere: a hollow ball that holds particles, or a solid one that they run into."""

from __future__ import annotations

from typing import Annotated, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Length, Point
from clast.maths.vec3 import ZERO, Vec, norm, scale, sub
from clast.parts.params import Params
from clast.parts.wall import Nearest, Wall
from clast.plugins.registry import Registry

RINGS, STRIPES = 24, 48
"""Of the drawn surface."""


class Sphere(Params):
    r"""A sphere, touched from inside or outside.

    Equation
    --------
    distance = s (R − |x − c|),  normal = s (x − c)/|x − c|

    Symbols
    -------
    c, R : ``centre`` and ``radius`` in m; x : centre of a particle; s : 1 inside, −1 outside

    Limits
    ------
    Contacts count as contacts with a flat wall, so the sphere must be much larger than the particles.
    """

    centre: Annotated[Point, Field(examples=[[0, 0, 0]], description="Middle of the sphere")]
    radius: Annotated[Length, Field(gt=0, examples=["20 mm"], description="Radius of the sphere")]
    side: Annotated[Literal["inside", "outside"], Field(description="where the particles are")] = "inside"


class Shape(NamedTuple):
    """Centre and radius in m, and +1 for inside, −1 for outside."""

    centre: Vec
    radius: float
    sign: float


def shape(params: Sphere) -> Shape:
    """Return the numbers of the sphere."""
    return Shape(params.centre, params.radius, 1.0 if params.side == "inside" else -1.0)


def nearest(shape: Shape, x: Vec) -> Nearest:
    """Return distance and direction from x to the surface.

    >>> nearest(Shape((0.0, 0.0, 0.0), radius=2.0, sign=1.0), (0.0, 0.5, 0.0))
    Nearest(distance=1.5, normal=(0.0, 1.0, 0.0))
    """
    outward = sub(x, shape.centre)
    out = norm(outward)
    if out == 0.0:
        return Nearest(shape.sign * shape.radius, ZERO)
    return Nearest(shape.sign * (shape.radius - out), scale(shape.sign / out, outward))


def centre(params: Sphere) -> Vec:
    """Return the point about which the moment is reported."""
    return params.centre


def mesh(params: Sphere, size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return the sphere in rings of triangles."""
    height = np.pi * np.arange(RINGS + 1) / RINGS
    turn = 2.0 * np.pi * np.arange(STRIPES) / STRIPES
    a, b = np.meshgrid(height, turn, indexing="ij")
    unit = np.stack([np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)], axis=-1).reshape(-1, 3)
    ring, k = np.divmod(np.arange(RINGS * STRIPES), STRIPES)
    after = (k + 1) % STRIPES
    here, beside, below, across = (
        ring * STRIPES + k,
        ring * STRIPES + after,
        ring * STRIPES + k + STRIPES,
        ring * STRIPES + after + STRIPES,
    )
    triangles = np.vstack([np.column_stack([here, beside, below]), np.column_stack([beside, across, below])])
    return np.asarray(params.centre) + params.radius * unit, triangles


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the sphere."""
    registry.wall(
        "sphere",
        Wall(
            summary="sphere, touched from inside or outside",
            Params=Sphere,
            Shape=Shape,
            shape=shape,
            nearest=nearest,
            centre=centre,
            mesh=mesh,
        ),
    )
