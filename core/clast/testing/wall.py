"""What holds for every wall: a distance that is one, a unit normal, and a picture of the same surface."""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.engine.wall_feet import feet
from clast.maths.vec3 import Vec, add, norm, scale, sub
from clast.parts.wall import Nearest, Wall
from clast.testing.bits import same_bits
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import numbers, vectors

CLOSE = 1e-3
"""Where above a place of touch the surface is asked again, as a share of the way to it."""


def claims(wall: Wall, params: Any) -> list[Claim]:
    """Return what a wall with parameters must keep to; lengths are tried about as large as its picture."""
    shape, size = wall.shape(params), _size(wall, params)
    about, far = vectors(1.5 * size), numbers(0.1 * size, size)

    def nearest(x: Vec) -> Nearest:
        found: Nearest = wall.nearest(shape, add(x, wall.centre(params)))
        return found

    of_touches = [
        claim(
            "where it is touched is nearest to what is just above",
            lambda x, r: _touched(wall, params, x, r),
            about,
            far,
        )
    ]
    return [
        claim("the normal is a unit vector, or 0 where none is right", lambda x: _unit_normal(nearest(x), x), about),
        claim("what lies nearest lies on the wall", lambda x: _on_the_wall(nearest, x, size), about),
        claim("moving changes the distance by no more than the way", lambda x, y: _steady(nearest, x, y), about, about),
        claim("the picture shows the surface that particles touch", lambda: _drawn(wall, params, shape, size)),
        *(of_touches if wall.touches is not None else []),
        claim("compiled code gives the same bits as plain Python", lambda: _compiled_alike(wall, shape, size)),
    ]


def _size(wall: Wall, params: Any) -> float:
    points, _ = wall.mesh(params, 0.05)
    return float(np.linalg.norm(np.asarray(points) - np.array(wall.centre(params)), axis=1).max())


def _unit_normal(near: Nearest, x: Vec) -> None:
    length = norm(near.normal)
    must(length == 0.0 or abs(length - 1.0) < 1e-9, lambda: f"{near} from {x}")


def _on_the_wall(nearest: Any, x: Vec, size: float) -> None:
    near = nearest(x)
    if norm(near.normal) == 0.0:  # all directions are alike, as on the axis of a tube
        return
    foot = add(x, scale(near.distance, near.normal))
    again = nearest(foot)
    must(abs(again.distance) < 1e-9 * size, lambda: f"{near} from {x}, but {again} from the point that it leads to")


def _steady(nearest: Any, x: Vec, y: Vec) -> None:
    a, b = nearest(x), nearest(y)
    if a.distance > 0.0 and b.distance > 0.0:  # behind a wall a particle may belong to another part of it
        way = norm(sub(y, x))
        must(abs(a.distance - b.distance) <= way * (1.0 + 1e-9) + 1e-12, lambda: f"{a} from {x}, {b} from {y}")


def _touched(wall: Wall, params: Any, x: Vec, reach: float) -> None:
    shape, at = wall.shape(params), add(x, wall.centre(params))
    found = feet(wall, params, np.array([at]), np.array([reach]))
    nearest, first = wall.nearest(shape, at).distance, float(found.distance.min(initial=np.inf))
    told = f"touched at {first} m, but the nearest point is at {nearest} m, within {reach} m of {x}"
    must(first == nearest or (first == np.inf and nearest >= reach), told)
    for distance, normal in zip(found.distance.tolist(), found.normal.tolist(), strict=True):
        n: Vec = (normal[0], normal[1], normal[2])
        again = wall.nearest(shape, add(at, scale((1.0 - CLOSE) * distance, n))).distance
        told = f"{again} m from the surface above a touch at {distance} m from {x}, where it is {CLOSE * distance} m"
        must(abs(again - CLOSE * distance) < 1e-9 * reach, told)


def _drawn(wall: Wall, params: Any, shape: Any, size: float) -> None:
    points, triangles = wall.mesh(params, 0.05)
    must(len(triangles) > 0 and int(np.max(triangles)) < len(points), "'mesh' has no triangles, or points are missing")
    worst = max(abs(wall.nearest(shape, tuple(map(float, point))).distance) for point in np.asarray(points)[:200])
    must(worst < 1e-6 * size, f"a point of 'mesh' is {worst:g} m off the wall")


def _compiled_alike(wall: Wall, shape: Any, size: float) -> None:
    nearest = wall.nearest

    def sweep(points: Any, shape: Any, out: Any) -> None:
        for k in range(len(points)):
            near = nearest(shape, (points[k, 0], points[k, 1], points[k, 2]))
            out[k, 0] = near.distance
            out[k, 1], out[k, 2], out[k, 3] = near.normal

    points = np.random.default_rng(12).normal(size=(500, 3)) * size
    same_bits(sweep, [nearest], (500, 4), points, shape)
    touches = wall.touches
    if touches is None:
        return

    def touching(points: Any, shape: Any, out: Any) -> None:
        for k in range(len(points)):
            out[k] = 0.0
            out[k, 4] = touches(shape, (points[k, 0], points[k, 1], points[k, 2]), size, out[k, :4].reshape(1, 4))

    same_bits(touching, [touches], (500, 5), points, shape)
