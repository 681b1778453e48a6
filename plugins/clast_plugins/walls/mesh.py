"""Mesh: a surface of triangles, such as that of an STL file."""

from __future__ import annotations

from functools import lru_cache
from math import inf
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.files import InputFile
from clast.config.problems import wrong
from clast.config.quantities import Length, Point
from clast.errors import ConfigError
from clast.maths.vec3 import ZERO, Vec
from clast.parts.params import Params
from clast.parts.wall import Nearest, Wall
from clast.plugins.registry import Registry
from clast_plugins.walls.surface.read import Triangles, content_of, refuse_bad, version
from clast_plugins.walls.surface.tree import Tree, planted
from clast_plugins.walls.surface.triangle import WIDTH, Foot, foot_on, outside, rows_of

FLAT = 1e-3
"""Angle in rad at which two faces meet and still count as one, and, times the distance, how near a foot must be to a
triangle to lie on it: rounding in files, which hold single precision, stays below."""

CANDIDATES = 64
"""Triangles within reach that are looked at; of more, the nearest."""

FOOT = 7
"""Numbers of a candidate before its triangle: distance, normal and foot."""


class Mesh(Params):
    r"""A surface of triangles, thin, touched from both sides; from an STL file, or written out.

    Equation
    --------
    A sphere at x touches the surface S at every foot y of x on S: where |x − y| is smallest among the points of S
    around y, and below the radius. The normal is (y − x)/|x − y|.

    Why it is right
    ---------------
    A foot is inside a triangle, on an edge or on a corner. The nearest point of a triangle to x is a foot of S unless
    some other triangle, that passes through it, has a nearer one. So a flat face is touched once however it is cut into
    triangles; a ridge or a tip once, and only where no face beside it is nearer; a groove on both its faces. Where a
    sphere rolls from a face over a ridge to the next, foot and normal move steadily, and the contact keeps its history:
    it goes on where the normal has turned least since the forces before.

    Limits
    ------
    Faces that meet at less than 0.06° count as flat, and gaps below a thousandth of the radius as closed, as STL files
    hold single precision. Contacts count as contacts with a flat wall, at ridges and tips too. A particle has at most
    ``contacts`` contacts with the wall at a time; a run in which it touches more stops. In a funnel of 24 faces a
    sphere has 24. Round surfaces are what the file makes of them: faces should not be much smaller than contacts, or a
    hollow is touched in several places where a round one is touched once. A particle whose centre passes the surface is
    pushed out behind: overlaps must stay small, as always.

    Source
    ------
    One contact for each face, edge or corner, and none that a nearer face beside it includes: L. Hu, G. M. Hu, Z. Q.
    Fang, Y. Zhang (2013), International Journal for Numerical Methods in Engineering 94, doi:10.1002/nme.4487. Nearest
    point of a triangle: C. Ericson (2005), Real-Time Collision Detection, Sect. 5.1.5; tree of boxes: Sect. 6.6.2.
    """

    file: Annotated[InputFile | None, Field(description="STL file, as text or binary")] = None
    unit: Annotated[
        Annotated[Length, Field(gt=0)] | None,
        Field(description="Length of one unit of the file, which STL does not tell"),
    ] = None
    triangles: Annotated[
        tuple[tuple[Point, Point, Point], ...] | None,
        Field(
            examples=[[[[0, 0, 0], ["10 mm", 0, 0], [0, "10 mm", 0]], [[0, 0, 0], [0, "10 mm", 0], [0, 0, "5 mm"]]]],
            description="Corners of triangles, instead of a file",
        ),
    ] = None
    origin: Annotated[Point, Field(description="Where the origin of file or triangles lies in the scene")] = ZERO
    contacts: Annotated[
        int, Field(ge=2, le=64, description="Most contacts that a particle has with the wall at a time")
    ] = 8

    @model_validator(mode="after")
    def _is_a_surface(self) -> Mesh:
        if (self.file is None) == (self.triangles is None):
            text = "exactly one of file and triangles is needed; given "
            raise wrong("triangles", f"{text}both") if self.file is not None else ValueError(f"{text}neither")
        if (self.file is None) != (self.unit is None):
            key = "file" if self.unit is None else "unit"
            text = "a file needs a unit, such as '1 mm'" if self.unit is None else "a unit is that of a file"
            raise wrong(key, f"{text}: an STL file does not tell what its numbers mean")
        try:
            surface(self)
        except ConfigError as error:
            raise wrong("file" if self.file is not None else "triangles", str(error)) from None
        return self


def surface(params: Mesh) -> Triangles:
    """Return the triangles, (t, 3, 3) in m.

    Raises
    ------
    ConfigError
        They are none.
    """
    if params.file is not None:
        assert params.unit is not None
        found = content_of(params.file).triangles * params.unit
    else:
        found = np.array(params.triangles, float).reshape(-1, 3, 3)
        refuse_bad(found)
    return np.asarray(found + np.array(params.origin))


class Shape(NamedTuple):
    """Rows of triangles, and the tree of boxes around them: corners of boxes in m, and where to go on."""

    triangles: NDArray[np.float64]
    boxes: NDArray[np.float64]
    links: NDArray[np.float64]


def shape(params: Mesh) -> Shape:
    """Return the numbers of the surface."""
    return _shape(params, version(params.file) if params.file is not None else None)


@lru_cache(maxsize=8)
def _shape(params: Mesh, version: tuple[int, int] | None) -> Shape:
    return laid_out(surface(params))


def laid_out(triangles: NDArray[np.float64]) -> Shape:
    """Return the numbers of a surface of triangles, (t, 3, 3) in m."""
    tree: Tree = planted(triangles)
    return Shape(rows_of(triangles[tree.order]).ravel(), tree.boxes.ravel(), tree.links.ravel())


def nearest(shape: Shape, x: Vec) -> Nearest:
    """Return distance and direction from x to the nearest point of all triangles."""
    best, node = Nearest(inf, ZERO), 0
    while node < len(shape.links) // 3:
        if outside(shape.boxes, 6 * node, x) >= best.distance * best.distance:
            node = int(shape.links[3 * node])
            continue
        for t in range(int(shape.links[3 * node + 1]), int(shape.links[3 * node + 2])):
            found = foot_on(shape.triangles, WIDTH * t, x)
            if found.distance < best.distance:
                best = Nearest(found.distance, found.normal)
        node += 1
    return best


def keep(table: NDArray[np.float64], count: int, found: Foot, triangle: int) -> int:
    """Note a foot, in place of the farthest where there is no room for more; return how many there are."""
    row = count
    if count == len(table):
        row = 0
        for k in range(1, count):
            if table[k, 0] > table[row, 0]:
                row = k
        if found.distance >= table[row, 0]:
            return count
    table[row, 0] = found.distance
    for c in range(3):
        table[row, 1 + c] = found.normal[c]
        table[row, 4 + c] = found.point[c]
    table[row, FOOT] = triangle
    return max(count, row + 1)


def near_feet(shape: Shape, x: Vec, reach: float, table: NDArray[np.float64]) -> int:
    """Write the nearest point of every triangle within reach; return how many there are."""
    count, node = 0, 0
    while node < len(shape.links) // 3:
        if outside(shape.boxes, 6 * node, x) >= reach * reach:
            node = int(shape.links[3 * node])
            continue
        for t in range(int(shape.links[3 * node + 1]), int(shape.links[3 * node + 2])):
            found = foot_on(shape.triangles, WIDTH * t, x)
            if found.distance < reach:
                count = keep(table, count, found, t)
        node += 1
    return count


def surpassed(shape: Shape, table: NDArray[np.float64], count: int, k: int) -> bool:
    """Tell whether a triangle that passes through foot k has a nearer one, or is the first of several that share it."""
    distance, point = table[k, 0], (table[k, 4], table[k, 5], table[k, 6])
    for other in range(count):
        less = table[other, 0]
        nearer = less < distance or (less == distance and other < k)
        if nearer and foot_on(shape.triangles, WIDTH * int(table[other, FOOT]), point).distance <= FLAT * less:
            return True
    return False


def touches(shape: Shape, x: Vec, reach: float, found: NDArray[np.float64]) -> int:
    """Write distance and normal of the feet of x within reach, the nearest if there are too many; return how many."""
    table = np.empty((CANDIDATES, FOOT + 1))
    count, told = near_feet(shape, x, reach, table), 0
    for k in range(count):
        if not surpassed(shape, table, count, k):
            told = note(found, told, table[k])
    return told


def note(found: NDArray[np.float64], told: int, foot: NDArray[np.float64]) -> int:
    """Insert a foot behind those that are nearer, as far as there is room; return how many there are."""
    at = told
    while at > 0 and found[at - 1, 0] > foot[0]:
        at -= 1
    if at == len(found):
        return told
    last = min(told, len(found) - 1)
    for k in range(last, at, -1):
        for c in range(4):
            found[k, c] = found[k - 1, c]
    for c in range(4):
        found[at, c] = foot[c]
    return last + 1


def slots(params: Mesh) -> int:
    """Return the most contacts of a particle at a time."""
    return params.contacts


def concerns(params: Mesh) -> tuple[str, ...]:
    """Return a sentence about triangles of the file that are left out."""
    return content_of(params.file).left_out if params.file is not None else ()


def centre(params: Mesh) -> Vec:
    """Return the middle of the box around, about which the moment is reported."""
    corners = surface(params).reshape(-1, 3)
    x, y, z = (0.5 * (corners.min(axis=0) + corners.max(axis=0))).tolist()
    return (x, y, z)


def mesh(params: Mesh, size: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return all corners and triangles."""
    return drawn(surface(params))


def drawn(triangles: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Return triangles, (t, 3, 3) in m, as corners (3 t, 3) and their numbers (t, 3)."""
    return triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the mesh."""
    registry.wall(
        "mesh",
        Wall(
            summary="surface of triangles, from an STL file, touched from both sides",
            Params=Mesh,
            Shape=Shape,
            shape=shape,
            nearest=nearest,
            touches=touches,
            slots=slots,
            centre=centre,
            mesh=mesh,
            concerns=concerns,
        ),
    )
