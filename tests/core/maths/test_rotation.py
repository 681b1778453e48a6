"""Rotations against scipy's, and the small motions that histories are carried by."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from scipy.spatial.transform import Rotation

from clast.maths.rotation import IDENTITY, chord, matrix, multiply, relative, rotate_back, spin_about, swing, turn
from clast.maths.rotation import rotate as apply
from clast.maths.vec3 import add, cross, dot, norm, scale, sub
from tests.support.strategies import assert_close, directions, negated, numbers, rotation, rotations, unit, vectors


def scipy_rotation(q) -> Rotation:
    return Rotation.from_quat([*q[1:], q[0]])


@settings(max_examples=60, deadline=None)
@given(q=rotations(), a=vectors())
def test_a_quaternion_turns_a_vector_as_its_matrix_does_and_back(q, a):
    R = matrix(q)
    np.testing.assert_allclose(R, scipy_rotation(q).as_matrix(), atol=1e-14)
    assert_close(apply(R, a), scipy_rotation(q).apply(a), 1e-14, 2.0)
    assert_close(rotate_back(R, apply(R, a)), a, 1e-14, 2.0)


@settings(max_examples=60, deadline=None)
@given(p=rotations(), q=rotations())
def test_a_product_turns_by_its_second_factor_first(p, q):
    expected = (scipy_rotation(p) * scipy_rotation(q)).as_matrix()
    np.testing.assert_allclose(matrix(multiply(p, q)), expected, atol=1e-14)


@settings(max_examples=100, deadline=None)
@given(p=rotations(), q=rotations())
def test_the_rotation_from_one_to_another_is_the_inverse_of_the_way_back_to_the_bit(p, q):
    there, back = relative(p, q), relative(q, p)
    assert back == (there[0], *negated(there[1:]))
    assert_close(multiply(p, there), q, 1e-15, 2.0)


@pytest.mark.parametrize(("most", "tolerance"), [(0.2, 1e-12), (1.5, 1e-5)])
@settings(max_examples=60, deadline=None)
@given(axis=directions(), share=numbers(0.0, 1.0), q=rotations())
def test_turning_is_as_exact_as_promised(most, tolerance, axis, share, q):
    angle = share * most
    turned = turn(q, scale(angle / 0.01, axis), 0.01)
    assert_close(turned, multiply(rotation(axis, angle), q), tolerance, 1.0)
    assert math.hypot(*turned) == pytest.approx(1.0, abs=tolerance)


@settings(max_examples=60, deadline=None)
@given(axis=directions(), angle=numbers(0.0, 0.2), a=vectors())
def test_a_chord_tells_exactly_how_a_vector_changes_as_it_turns(axis, angle, a):
    turned = apply(matrix(rotation(axis, angle)), a)
    expected = cross(chord(scale(angle / 0.01, axis), 0.01), scale(0.5, add(a, turned)))
    assert_close(sub(turned, a), expected, 6e-8 * angle + 1e-15, norm(a))


def test_twenty_thousand_small_turns_keep_the_norm():
    q = IDENTITY
    for _ in range(20_000):
        q = turn(q, (30.0, -20.0, 50.0), 1e-3)
    assert math.hypot(*q) == pytest.approx(1.0, abs=1e-13)


@settings(max_examples=60, deadline=None)
@given(old=directions(), new=directions(), a=vectors())
def test_a_swing_is_the_shortest_rotation_between_two_directions(old, new, a):
    assume(dot(old, new) > -0.99)
    assume(norm(cross(old, new)) > 1e-6)
    side = sub(a, scale(dot(a, old), old))
    axis, angle = unit(cross(old, new)), math.atan2(norm(cross(old, new)), dot(old, new))
    assert_close(swing(side, old, new), apply(matrix(rotation(axis, angle)), side), 1e-10, 1.0)
    assert dot(swing(side, old, new), new) == pytest.approx(0.0, abs=1e-12)


@settings(max_examples=60, deadline=None)
@given(axis=directions(), a=vectors(), angle=numbers(-0.1, 0.1))
def test_spinning_about_an_axis_keeps_the_length_and_the_angle_to_third_order(axis, a, angle):
    side = sub(a, scale(dot(a, axis), axis))
    spun = spin_about(side, axis, angle)
    assert norm(spun) == pytest.approx(norm(side), abs=1e-15)
    assert_close(spun, apply(matrix(rotation(axis, angle)), side), 0.1 * abs(angle) ** 3 + 1e-15, 2.0)
