"""Every wall shape: its distance is a distance, its normal the way along which it shrinks, its picture its surface."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings

from clast.maths.vec3 import add, norm, scale, sub
from clast.parts.examples import example
from clast.parts.wall import Wall
from clast.plugins.discovery import discover
from tests.support.strategies import numbers, vectors

SIZE = 0.05
"""Of the room in m in which points are drawn: the examples are of some millimetres to centimetres."""


def part(name: str) -> Wall:
    return discover().get("wall", name).part


def variants() -> list[tuple[str, dict[str, object]]]:
    """Return every wall, on both sides where it has two."""
    found: list[tuple[str, dict[str, object]]] = []
    for name in discover().names("wall"):
        sides = ("inside", "outside") if "side" in part(name).Params.model_fields else (None,)
        found += [(name, {} if side is None else {"side": side}) for side in sides]
    return [*found, ("plane", {"radius": 0.01})]


each = pytest.mark.parametrize(("name", "changes"), variants(), ids=lambda value: str(value))


@each
@settings(max_examples=60, deadline=None)
@given(x=vectors(SIZE), y=vectors(SIZE))
def test_two_points_differ_in_distance_by_no_more_than_they_are_apart(name, changes, x, y):
    wall = part(name)
    shape = wall.shape(example(wall.Params, changes))
    far, near = wall.nearest(shape, x).distance, wall.nearest(shape, y).distance
    assert abs(far - near) <= norm(sub(x, y)) * (1.0 + 1e-9) + 1e-15


@each
@settings(max_examples=60, deadline=None)
@given(x=vectors(SIZE), share=numbers(0.0, 1.0))
def test_on_the_way_along_the_normal_the_distance_shrinks_to_nothing(name, changes, x, share):
    wall = part(name)
    shape = wall.shape(example(wall.Params, changes))
    near = wall.nearest(shape, x)
    assume(abs(near.distance) > 1e-9)
    assume(norm(near.normal) > 0.0)
    assert norm(near.normal) == pytest.approx(1.0, abs=1e-12)
    on = wall.nearest(shape, add(x, scale(share * near.distance, near.normal)))
    assert on.distance == pytest.approx((1.0 - share) * near.distance, abs=1e-12)


@each
def test_the_drawn_surface_lies_on_the_wall(name, changes):
    wall = part(name)
    params = example(wall.Params, changes)
    points, triangles = wall.mesh(params, 0.03)
    away = [wall.nearest(wall.shape(params), tuple(x)).distance for x in points.tolist()]
    assert np.abs(away).max() < 1e-9
    assert triangles.min() >= 0
    assert triangles.max() < len(points)
    corners = points[triangles]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    assert areas.sum() > 0.0


def test_a_block_without_a_volume_is_refused():
    with pytest.raises(ValueError, match="upper must be above lower along y"):
        part("block").Params(lower=[0, 1, 0], upper=[1, 1, 1])


@pytest.mark.parametrize(
    ("x", "normal"),
    [
        ((0.1, 0.5, 0.5), (1.0, 0.0, 0.0)),
        ((0.9, 0.5, 0.5), (-1.0, 0.0, 0.0)),
        ((0.5, 0.1, 0.5), (0.0, 1.0, 0.0)),
        ((0.5, 0.9, 0.5), (0.0, -1.0, 0.0)),
        ((0.5, 0.5, 0.1), (0.0, 0.0, 1.0)),
        ((0.5, 0.5, 0.9), (0.0, 0.0, -1.0)),
    ],
)
def test_what_is_inside_a_block_is_pushed_out_through_the_nearest_face(x, normal):
    block = part("block")
    near = block.nearest(block.shape(block.Params(lower=[0, 0, 0], upper=[1, 1, 1])), x)
    assert near.distance == pytest.approx(-0.1)
    assert near.normal == normal
