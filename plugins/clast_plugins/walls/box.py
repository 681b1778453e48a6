"""Box: a container of thin faces along the axes, some of which may be missing."""

from __future__ import annotations

from functools import lru_cache
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.problems import wrong
from clast.config.quantities import Point
from clast.maths.vec3 import Vec
from clast.parts.params import Params
from clast.parts.wall import Wall
from clast.plugins.registry import Registry
from clast_plugins.walls.mesh import Shape, drawn, laid_out, nearest, touches

FACES = ("left", "right", "front", "back", "bottom", "top")
"""Those with the smallest and the largest x, y and z."""
Face = Literal["left", "right", "front", "back", "bottom", "top"]


class Box(Params):
    """A container of up to six thin faces along the axes, touched from inside and outside.

    Why it is right
    ---------------
    Each face is two triangles of a ``mesh``: a sphere in a corner touches three faces, one beside a rim the rim.

    Limits
    ------
    Faces are thin: a particle whose centre passes one is pushed out on the other side. A face that moves by itself, as
    a piston does, or whose force is wanted alone, is a wall of its own: leave it ``open`` here.

    Source
    ------
    As of ``mesh``.
    """

    lower: Annotated[Point, Field(examples=[[0, 0, 0]], description="Corner with the smallest coordinates")]
    upper: Annotated[Point, Field(examples=[["10 mm", "10 mm", "5 mm"]], description="Corner with the largest")]
    open: Annotated[tuple[Face, ...], Field(examples=[["top"]], description="Faces that are missing")] = ()

    @model_validator(mode="after")
    def _has_faces_and_a_volume(self) -> Box:
        for axis, low, high in zip("xyz", self.lower, self.upper, strict=True):
            if not low < high:
                raise wrong("upper", f"upper must be above lower along {axis}; given {high:g} m and {low:g} m")
        if set(self.open) == set(FACES):
            raise wrong("open", "all six faces are open, so nothing is left of the box")
        return self


@lru_cache(maxsize=8)
def shape(params: Box) -> Shape:
    """Return the numbers of the faces."""
    return laid_out(triangles(params))


def triangles(params: Box) -> NDArray[np.float64]:
    """Return two triangles for each face that is there, (t, 3, 3) in m.

    >>> len(triangles(Box(lower=[0, 0, 0], upper=[1, 1, 1], open=["top"])))
    10
    """
    corners = np.array([params.lower, params.upper])
    found = []
    for number, face in enumerate(FACES):
        if face in params.open:
            continue
        axis, side = divmod(number, 2)
        first, second = (axis + 1) % 3, (axis + 2) % 3
        square = np.empty((4, 3))
        square[:, axis] = corners[side, axis]
        square[:, first] = corners[[0, 1, 1, 0], first]
        square[:, second] = corners[[0, 0, 1, 1], second]
        found += [square[[0, 1, 2]], square[[0, 2, 3]]]
    return np.array(found)


def slots(params: Box) -> int:
    """Return the most contacts of a particle at a time: one on each face that is there."""
    return len(FACES) - len(set(params.open))


def centre(params: Box) -> Vec:
    """Return the middle, about which the moment is reported."""
    low, high = params.lower, params.upper
    return (0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2]))


def mesh(params: Box, size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return all corners and triangles."""
    return drawn(triangles(params))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the box."""
    registry.wall(
        "box",
        Wall(
            summary="container of thin faces along the axes, some of which may be open",
            Params=Box,
            Shape=Shape,
            shape=shape,
            nearest=nearest,
            touches=touches,
            slots=slots,
            centre=centre,
            mesh=mesh,
        ),
    )
