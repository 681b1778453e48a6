"""Walls: the nearest point of a plane, a disc and a cylinder, against points sampled on their surface."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from clast.maths.vec3 import Vec, add, cross, dot, norm, scale, sub
from clast.parts.wall import Nearest
from clast_plugins.walls import cylinder, disc, plane
from tests.support.strategies import assert_close, directions, numbers, rotate, rotations, unit, vectors

ANGLES = np.linspace(0.0, 2.0 * math.pi, 181)


def axes(n: Vec) -> tuple[Vec, Vec]:
    helper = min(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), key=lambda e: abs(dot(e, n)))
    e1 = unit(cross(n, helper))
    return e1, cross(n, e1)


def rings(n: Vec, radii: np.ndarray) -> np.ndarray:
    """Return points on rings about the origin across n, (k, 3)."""
    e1, e2 = (np.array(e) for e in axes(n))
    ring = np.outer(np.cos(ANGLES), e1) + np.outer(np.sin(ANGLES), e2)
    return (radii[:, None, None] * ring).reshape(-1, 3)


def tube(shape: cylinder.Shape, x: Vec) -> np.ndarray:
    heights = dot(sub(x, shape.point), shape.axis) + np.linspace(-1.0, 1.0, 41)
    ring = rings(shape.axis, np.array([shape.radius]))
    return np.array(shape.point) + (ring[:, None] + heights[:, None] * np.array(shape.axis)).reshape(-1, 3)


def closest(points: np.ndarray, x: Vec) -> float:
    return float(np.linalg.norm(points - np.array(x), axis=1).min())


def foot(x: Vec, near: Nearest) -> Vec:
    return add(x, scale(near.distance, near.normal))


@settings(max_examples=60, deadline=None)
@given(point=vectors(), normal=vectors(3.0), x=vectors(5.0))
def test_an_infinite_plane_pushes_to_its_front_from_either_side(point, normal, x):
    assume(norm(normal) > 0.1)
    near = plane.nearest(plane.shape(plane.Plane(point=point, normal=normal)), x)
    n = unit(normal)
    assert near.distance == pytest.approx(dot(sub(x, point), n), abs=1e-13)
    assert_close(near.normal, scale(-1.0, n), 1e-15)
    assert dot(sub(foot(x, near), point), n) == pytest.approx(0.0, abs=1e-13)


@settings(max_examples=60, deadline=None)
@given(point=vectors(), n=directions(), radius=numbers(0.1, 2.0), x=vectors(4.0))
def test_no_point_of_a_disc_is_nearer_than_the_nearest_point_which_lies_on_it(point, n, radius, x):
    near = disc.nearest(disc.shape(disc.Disc(point=point, normal=n, radius=radius)), x)
    samples = np.array(point) + rings(n, np.linspace(0.0, radius, 60))
    assert near.distance >= 0.0
    assert near.distance <= closest(samples, x) + 1e-12
    assert near.distance == pytest.approx(closest(samples, x), abs=0.04 * radius)
    on = sub(foot(x, near), point)
    assert dot(on, n) == pytest.approx(0.0, abs=1e-12)
    assert norm(on) <= radius + 1e-12
    assert norm(near.normal) == pytest.approx(1.0, abs=1e-14)


@settings(max_examples=60, deadline=None)
@given(
    n=directions(),
    radius=numbers(0.1, 2.0),
    out=numbers(0.0, 2.0),
    height=numbers(-2.0, 2.0),
    turn=numbers(0, 6),
)
def test_beside_a_disc_the_nearest_point_is_on_the_rim(n, radius, out, height, turn):
    assume(out > 1e-6)
    e1, e2 = axes(n)
    side = add(scale(math.cos(turn), e1), scale(math.sin(turn), e2))
    x = add(scale(radius + out, side), scale(height, n))
    near = disc.nearest(disc.shape(disc.Disc(point=(0, 0, 0), normal=n, radius=radius)), x)
    assert near.distance == pytest.approx(math.hypot(out, height), rel=1e-9)
    assert_close(foot(x, near), scale(radius, side), 1e-12, 4.0)


@settings(max_examples=30, deadline=None)
@given(n=directions(), radius=numbers(0.1, 2.0), inside=numbers(0.0, 0.99), height=numbers(-2.0, 2.0))
def test_over_its_face_a_disc_is_its_plane_seen_from_either_side(n, radius, inside, height):
    x = add(scale(inside * radius, axes(n)[0]), scale(height, n))
    near = disc.nearest(disc.shape(disc.Disc(point=(0, 0, 0), normal=n, radius=radius)), x)
    assert near.distance == pytest.approx(abs(height), abs=1e-13)


def test_a_centre_on_a_disc_is_pushed_to_its_front():
    near = disc.nearest(disc.shape(disc.Disc(point=(0, 0, 0), normal=(0, 0, 2), radius=1.0)), (0.3, 0.0, 0.0))
    assert near == Nearest(0.0, (0.0, 0.0, -1.0))


@pytest.mark.parametrize("side", ["inside", "outside"])
@settings(max_examples=40, deadline=None)
@given(point=vectors(), axis=vectors(3.0), radius=numbers(0.2, 2.0), x=vectors(4.0))
def test_no_point_of_a_cylinder_is_nearer_than_the_nearest_point_which_lies_on_it(side, point, axis, radius, x):
    assume(norm(axis) > 0.1)
    shape = cylinder.shape(cylinder.Cylinder(point=point, axis=axis, radius=radius, side=side))
    away = sub(x, point)
    out = norm(sub(away, scale(dot(away, shape.axis), shape.axis)))
    assume(out > 1e-3)
    near = cylinder.nearest(shape, x)
    assert (near.distance > 0.0) == ((out < radius) == (side == "inside")) or near.distance == 0.0
    sampled = closest(tube(shape, x), x)
    assert abs(near.distance) <= sampled + 1e-12
    assert abs(near.distance) == pytest.approx(sampled, abs=0.05 * radius)
    on = sub(foot(x, near), point)
    assert norm(sub(on, scale(dot(on, shape.axis), shape.axis))) == pytest.approx(radius, rel=1e-11)
    assert dot(near.normal, shape.axis) == pytest.approx(0.0, abs=1e-12)


def test_on_the_axis_of_a_cylinder_no_direction_is_preferred():
    shape = cylinder.shape(cylinder.Cylinder(point=(0, 0, 0), axis=(0, 0, 1), radius=2.0))
    assert cylinder.nearest(shape, (0.0, 0.0, 5.0)) == Nearest(2.0, (0.0, 0.0, 0.0))


@settings(max_examples=30, deadline=None)
@given(
    q=rotations(),
    x=vectors(3.0),
    radius=st.one_of(st.none(), numbers(0.2, 2.0)),
    n=directions(),
    point=vectors(),
)
def test_a_rotated_world_gives_the_same_distance_in_a_rotated_direction(q, x, radius, n, point):
    def seen(point, n, x):
        if radius is None:
            return plane.nearest(plane.shape(plane.Plane(point=point, normal=n)), x)
        return disc.nearest(disc.shape(disc.Disc(point=point, normal=n, radius=radius)), x)

    here = seen(point, n, x)
    assume(here.distance > 1e-3)
    there = seen(rotate(q, point), rotate(q, n), rotate(q, x))
    assert there.distance == pytest.approx(here.distance, abs=1e-12)
    assert_close(there.normal, rotate(q, here.normal), 1e-9, 1.0)


@pytest.mark.parametrize(
    ("part", "wall", "reach"),
    [
        (plane, plane.Plane(point=(1, 2, 3), normal=(1, 1, 0)), 2.0),
        (disc, disc.Disc(point=(1, 2, 3), normal=(1, 1, 0), radius=0.7), 0.7),
    ],
)
def test_the_drawn_surface_of_a_plane_and_a_disc_lies_on_it(part, wall, reach):
    points, triangles = part.mesh(wall, 2.0)
    away = points - np.array([1.0, 2.0, 3.0])
    assert away @ np.array([1.0, 1.0, 0.0]) == pytest.approx(0.0, abs=1e-12)
    assert np.linalg.norm(away, axis=1).max() == pytest.approx(reach)
    assert set(triangles.ravel()) == set(range(len(points)))


def test_the_drawn_surface_of_a_cylinder_lies_on_it():
    wall = cylinder.Cylinder(point=(1, 2, 3), axis=(0, 2, 0), radius=0.7)
    points, triangles = cylinder.mesh(wall, 2.0)
    assert np.hypot(points[:, 0] - 1.0, points[:, 2] - 3.0) == pytest.approx(0.7)
    assert set(triangles.ravel()) == set(range(len(points)))
