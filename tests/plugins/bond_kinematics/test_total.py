"""Total kinematics: objective strains, and loads that are the gradient of one energy."""

from __future__ import annotations

import math
from decimal import Decimal, localcontext
from typing import NamedTuple

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from clast.maths.rotation import Quat, multiply
from clast.maths.vec3 import Vec, add, cross, dot, scale
from clast.parts.bond_kinematics import BondMotion, EndLoads
from clast.parts.bond_model import BondLoad, Strain
from clast_plugins.bond_kinematics.total import Reference, arctangent_rest, end_loads, measure
from tests.support.strategies import (
    assert_close,
    assert_turned,
    directions,
    negated,
    numbers,
    rotate,
    rotation,
    rotations,
    turned_a_little,
    vectors,
)

REST: Vec = (0.0, 0.0, 0.0)
LENGTH = 1.3


class Pose(NamedTuple):
    """Centre vector and orientations of a deformed bond, and its direction when it was made."""

    d: Vec
    q_i: Quat
    q_j: Quat
    n0: Vec


@st.composite
def poses(draw, most: float = math.radians(150.0)):
    """Draw a bond that is stretched, sheared, twisted and bent, its ends turned by up to ``most``."""
    n0, q_i = draw(directions()), draw(rotations())
    relative = draw(rotations(most))
    d = rotate(q_i, scale(draw(numbers(0.6, 1.6)), add(n0, draw(vectors(0.7)))))
    assume(dot(d, d) > 0.04)
    return Pose(d, q_i, multiply(q_i, relative), n0)


def strain_of(pose: Pose):
    motion = BondMotion(pose.d, pose.q_i, pose.q_j, REST, REST, REST)
    strain, frame, _ = measure(motion, Reference(pose.n0, LENGTH), None, 0.0)
    return strain, frame


def stiff(strain: Strain) -> BondLoad:
    return BondLoad(3.0 * strain.axial, scale(1.7, strain.shear), 0.6 * strain.twist, scale(0.9, strain.bending))


def energy(pose: Pose) -> float:
    e, _ = strain_of(pose)
    return 0.5 * (3.0 * e.axial**2 + 1.7 * dot(e.shear, e.shear) + 0.6 * e.twist**2 + 0.9 * dot(e.bending, e.bending))


def loads(pose: Pose) -> EndLoads:
    strain, frame = strain_of(pose)
    return end_loads(stiff(strain), frame)


def size(ends: EndLoads) -> float:
    return max(abs(x) for vector in ends for x in vector) + 1e-6


def slope(function, h: float = 1e-3) -> float:
    """Return the derivative at 0 by central differences of fourth order."""
    near, far = function(h) - function(-h), function(2.0 * h) - function(-2.0 * h)
    return (8.0 * near - far) / (12.0 * h)


def moved(d: Vec, component: int, by: float) -> Vec:
    return add(d, tuple(by if k == component else 0.0 for k in range(3)))


@settings(max_examples=40, deadline=None)
@given(pose=poses())
def test_force_and_moments_are_minus_the_gradient_of_one_energy(pose):
    ends = loads(pose)
    for k in range(3):
        found = (
            -slope(lambda h, k=k: energy(pose._replace(d=moved(pose.d, k, h)))),
            -slope(lambda h, k=k: energy(pose._replace(q_i=turned_a_little(pose.q_i, k, h)))),
            -slope(lambda h, k=k: energy(pose._replace(q_j=turned_a_little(pose.q_j, k, h)))),
        )
        assert_close(found, [ends.force[k], ends.moment_i[k], ends.moment_j[k]], 1e-8, size(ends))


@settings(max_examples=100, deadline=None)
@given(pose=poses())
def test_a_bond_neither_pushes_nor_turns_the_pair_as_a_whole(pose):
    force, moment_i, moment_j = ends = loads(pose)
    assert_close(
        add(add(moment_i, moment_j), cross(pose.d, force)),
        REST,
        1e-12,
        size(ends) * (1.0 + dot(pose.d, pose.d)),
    )


@settings(max_examples=100, deadline=None)
@given(pose=poses(), q=rotations())
def test_a_rigid_rotation_changes_no_strain_and_turns_the_loads_with_it(pose, q):
    turned = Pose(rotate(q, pose.d), multiply(q, pose.q_i), multiply(q, pose.q_j), pose.n0)
    before, after = strain_of(pose)[0], strain_of(turned)[0]
    assert_close([after.axial, *after.shear], [before.axial, *before.shear], 1e-13, 1.0)
    assert_close([after.twist, *after.bending], [before.twist, *before.bending], 1e-12, 1.0)
    for a, b in zip(loads(turned), loads(pose), strict=True):
        assert_turned(a, b, q, size(loads(pose)))


@settings(max_examples=50, deadline=None)
@given(n0=directions(), q=rotations())
def test_a_bond_that_only_moved_as_a_whole_carries_nothing(n0, q):
    ends = loads(Pose(rotate(q, scale(LENGTH, n0)), q, q, n0))
    assert_close([*ends.force, *ends.moment_i, *ends.moment_j], [0.0] * 9, 1e-14, 1.0)


@settings(max_examples=100, deadline=None)
@given(pose=poses())
def test_swapping_the_ends_mirrors_strains_and_loads_to_the_bit(pose):
    swapped = Pose(negated(pose.d), pose.q_j, pose.q_i, negated(pose.n0))
    here, there = strain_of(pose)[0], strain_of(swapped)[0]
    assert there == Strain(here.axial, negated(here.shear), here.twist, negated(here.bending))
    force, moment_i, moment_j = loads(pose)
    assert loads(swapped) == EndLoads(negated(force), moment_j, moment_i)


@settings(max_examples=100, deadline=None)
@given(pose=poses(), flip=st.sampled_from([(True, False), (False, True), (True, True)]))
def test_a_quaternion_and_its_negative_are_the_same_orientation_to_the_bit(pose, flip):
    q_i = negated(pose.q_i) if flip[0] else pose.q_i
    q_j = negated(pose.q_j) if flip[1] else pose.q_j
    same = pose._replace(q_i=q_i, q_j=q_j)
    assert strain_of(same)[0] == strain_of(pose)[0]
    assert loads(same) == loads(pose)


@settings(max_examples=100, deadline=None)
@given(n0=directions(), axis=directions(), angle=numbers(0.0, math.radians(179.0)))
def test_the_relative_rotation_of_the_ends_is_measured_exactly(n0, axis, angle):
    pose = Pose(scale(LENGTH, n0), (1.0, 0.0, 0.0, 0.0), rotation(axis, angle), n0)
    strain, _ = strain_of(pose)
    theta = add(scale(strain.twist, n0), strain.bending)
    assert_close(theta, scale(angle, axis), 1e-13, 1.0)
    assert dot(strain.bending, n0) == pytest.approx(0.0, abs=1e-14)


@settings(max_examples=50, deadline=None)
@given(n0=directions(), stretch=numbers(0.5, 2.0), side=directions(), angle=numbers(0.0, 1.0))
def test_axial_and_shear_follow_their_definitions(n0, stretch, side, angle):
    across = cross(n0, side)
    assume(dot(across, across) > 0.01)
    n = rotate(rotation(scale(1.0 / math.sqrt(dot(across, across)), across), angle), n0)
    strain, _ = strain_of(Pose(scale(stretch * LENGTH, n), (1.0, 0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0), n0))
    assert strain.axial == pytest.approx((stretch - 1.0) * LENGTH, abs=1e-14)
    assert math.sqrt(dot(strain.shear, strain.shear)) == pytest.approx(LENGTH * math.sin(angle), abs=1e-14)
    assert dot(strain.shear, n0) == pytest.approx(0.0, abs=1e-14)


def exact_rest(z: float) -> Decimal:
    """Return (atan(√z)/√z − 1)/z by Euler's series in forty digits."""
    with localcontext() as context:
        context.prec = 45
        exact = Decimal(z)
        ratio, term, total = exact / (1 + exact), 1 / (1 + exact), Decimal(0)
        for n in range(1, 170):
            total += term
            term *= ratio * 2 * n / (2 * n + 1)
        return (total - 1) / exact


@settings(max_examples=60, deadline=None)
@given(z=numbers(1e-12, 1.0))
def test_the_fit_of_the_arctangent_is_exact_to_1e_15(z):
    assert abs(Decimal(arctangent_rest(z)) - exact_rest(z)) <= Decimal("1e-15")


def test_the_fit_of_the_arctangent_has_the_right_limit():
    assert arctangent_rest(0.0) == pytest.approx(-1.0 / 3.0, abs=1e-15)
