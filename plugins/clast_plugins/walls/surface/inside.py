"""How deep points lie inside a closed surface of triangles, and where they go that lie too near to it."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.maths.vec3 import Vec, add, cross, dot, scale, sub
from clast_plugins.walls.surface.tree import Tree
from clast_plugins.walls.surface.triangle import WIDTH, Foot, foot_on, outside, rows_of, vector_at

Floats = NDArray[np.float64]
RAY = (0.37612, 0.54177, 0.75170)
"""Direction in which faces are counted: none that a drawn body has edges along."""

MOVES = 60
"""How often a point is moved on that one face has sent too near to another."""

ROUNDING = 1e-12
"""Share of a margin by which a point may lack it."""


class Surface(NamedTuple):
    """Rows of triangles in the order of the tree of boxes around them, and the tree."""

    rows: Floats
    boxes: Floats
    links: Floats


def surface_of(triangles: Floats, tree: Tree) -> Surface:
    """Return triangles (t, 3, 3) as they are walked."""
    return Surface(rows_of(triangles[tree.order]).ravel(), tree.boxes.ravel(), tree.links.ravel())


def nearest_foot(surface: Surface, x: Vec) -> Foot:
    """Return the nearest point of all triangles."""
    best, node = foot_on(surface.rows, 0, x), 0
    while node < len(surface.links) // 3:
        if outside(surface.boxes, 6 * node, x) >= best.distance * best.distance:
            node = int(surface.links[3 * node])
            continue
        for t in range(int(surface.links[3 * node + 1]), int(surface.links[3 * node + 2])):
            found = foot_on(surface.rows, WIDTH * t, x)
            if found.distance < best.distance:
                best = found
        node += 1
    return best


def is_hit(boxes: Floats, k: int, x: Vec) -> bool:
    """Tell whether the ray from x meets a box."""
    first, last = 0.0, np.inf
    for c in range(3):
        first = max(first, (boxes[k + c] - x[c]) / RAY[c])
        last = min(last, (boxes[k + 3 + c] - x[c]) / RAY[c])
    return first <= last


def meets(rows: Floats, k: int, x: Vec) -> bool:
    """Tell whether the ray from x goes through a triangle, as T. Möller and B. Trumbore (1997) do."""
    b, c = vector_at(rows, k + 3), vector_at(rows, k + 6)
    p = cross(RAY, c)
    size = dot(b, p)
    if size == 0.0:
        return False
    way = sub(x, vector_at(rows, k))
    q = cross(way, b)
    u, v, t = dot(way, p) / size, dot(RAY, q) / size, dot(c, q) / size
    return u >= 0.0 and v >= 0.0 and u + v <= 1.0 and t > 0.0


def is_inside(surface: Surface, x: Vec) -> bool:
    """Tell whether a ray from x leaves the body: it then goes through an odd number of faces."""
    count, node = 0, 0
    while node < len(surface.links) // 3:
        if not is_hit(surface.boxes, 6 * node, x):
            node = int(surface.links[3 * node])
            continue
        for t in range(int(surface.links[3 * node + 1]), int(surface.links[3 * node + 2])):
            count += 1 if meets(surface.rows, WIDTH * t, x) else 0
        node += 1
    return count % 2 == 1


def depth(surface: Surface, x: Vec) -> float:
    """Return the distance of x from the surface, negative outside."""
    distance = nearest_foot(surface, x).distance
    return distance if is_inside(surface, x) else -distance


def moved_in(surface: Surface, x: Vec, margin: float) -> tuple[Vec, bool]:
    """Return x moved away from the nearest point, again and again, until it has its margin; and whether it has."""
    for _ in range(MOVES):
        foot = nearest_foot(surface, x)
        inside = is_inside(surface, x)
        if inside and foot.distance >= margin * (1.0 - ROUNDING):
            return x, True
        lacking = foot.distance - margin if inside else foot.distance + margin
        x = add(x, scale(lacking, foot.normal))
    return x, False


def depths(surface: Surface, points: Floats) -> Floats:
    """Return the depths of points, (n,) from (n, 3)."""
    found = np.empty(len(points))
    _compiled(_depths)(surface, points, found)
    return found


def all_moved_in(surface: Surface, points: Floats, margin: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    """Return points (n, 3) moved to where they keep their margins (n,), and which of them do."""
    moved, kept = points.copy(), np.zeros(len(points), np.bool_)
    _compiled(_moves)(surface, moved, margin, kept)
    return moved, kept


def _depths(surface: Any, points: Any, found: Any) -> None:
    for k in range(len(points)):
        found[k] = depth(surface, (points[k, 0], points[k, 1], points[k, 2]))


def _moves(surface: Any, points: Any, margin: Any, kept: Any) -> None:
    for k in range(len(points)):
        place, kept[k] = moved_in(surface, (points[k, 0], points[k, 1], points[k, 2]), margin[k])
        points[k, 0], points[k, 1], points[k, 2] = place


@cache
def _compiled(loop: Callable[..., None]) -> Callable[..., None]:
    from numba import njit

    from clast.engine.assemble import let_compiled_code_call
    from clast.engine.compiler import STRICT

    let_compiled_code_call([depth, moved_in])
    compiled: Callable[..., None] = njit(**STRICT)(loop)
    return compiled
