"""Incremental kinematics: the paper's Eqs. 3–6, in a frame carried with the bond."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings

from clast.maths.rotation import Quat
from clast.maths.vec3 import Vec, add, cross, dot, scale, sub
from clast.parts.bond_kinematics import BondMotion, EndLoads
from clast.parts.bond_model import BondLoad, Strain
from clast_plugins.bond_kinematics import total
from clast_plugins.bond_kinematics.incremental import Reference, State, end_loads, measure, start
from tests.support.strategies import (
    assert_close,
    assert_turned,
    directions,
    negated,
    numbers,
    rotate,
    rotation,
    rotations,
    vectors,
)

REST: Vec = (0.0, 0.0, 0.0)
STILL: Quat = (1.0, 0.0, 0.0, 0.0)
LENGTH, DT = 1.3, 1e-3


def fresh(d: Vec) -> State:
    """Return the state of one bond when it is made."""
    state = start(np.array([d]), np.array([LENGTH]))
    return State(*(tuple(f[0].tolist()) if f.ndim == 2 else float(f[0]) for f in map(np.asarray, state)))


def moving(d: Vec, v: Vec = REST, w_i: Vec = REST, w_j: Vec = REST) -> BondMotion:
    return BondMotion(d, STILL, STILL, v, w_i, w_j)


def carried(old: Vec, d: Vec, w: Vec, dt: float) -> BondMotion:
    """Return the motion of a bond that went from ``old`` to ``d`` in a step while both ends turned with w."""
    return moving(d, scale(1.0 / dt, sub(d, old)), w, w)


def step(motion: BondMotion, state: State, dt: float = DT) -> tuple[Strain, State, EndLoads]:
    strain, frame, state = measure(motion, Reference(LENGTH), state, dt)
    return strain, state, end_loads(stiff(strain), frame)


def stiff(strain: Strain) -> BondLoad:
    return BondLoad(3.0 * strain.axial, scale(1.7, strain.shear), 0.6 * strain.twist, scale(0.9, strain.bending))


def in_space(state: State) -> tuple[Vec, Vec]:
    """Return the summed shear displacement and rotation as vectors in space."""
    e2 = cross(state.n, state.e1)
    slip = add(scale(state.u1, state.e1), scale(state.u2, e2))
    turn = add(scale(state.twist, state.n), add(scale(state.b1, state.e1), scale(state.b2, e2)))
    return slip, turn


def across(a: Vec, n: Vec) -> Vec:
    return sub(a, scale(dot(a, n), n))


def strained(d: Vec, slip: Vec, turn: Vec) -> State:
    """Return a state whose sums are given vectors in space."""
    state = fresh(d)
    e1, e2 = state.e1, cross(state.n, state.e1)
    return state._replace(
        u1=dot(slip, e1), u2=dot(slip, e2), twist=dot(turn, state.n), b1=dot(turn, e1), b2=dot(turn, e2)
    )


@settings(max_examples=60, deadline=None)
@given(n=directions(), w=vectors(5.0), dt=numbers(0.01, 0.5))
def test_translating_and_turning_as_a_whole_strains_nothing_but_by_what_the_series_leaves_out(n, w, dt):
    d, state = scale(LENGTH, n), fresh(scale(LENGTH, n))
    axis, rate = axis_angle(w)
    assume(rate * dt < 1.0)
    left_out = 0.06 * (0.5 * rate * dt) ** 6 * rate * dt * LENGTH  # 17/315 and what follows
    for k in range(1, 11):
        old, d = d, rotate(rotation(axis, rate * dt), d)
        strain, state, _ = step(carried(old, d, w, dt), state, dt)
        assert strain.axial == pytest.approx(0.0, abs=1e-14)
        assert math.hypot(*strain.shear) <= k * left_out + 1e-14
        assert (strain.twist, strain.bending) == (0.0, REST)


@settings(max_examples=60, deadline=None)
@given(n=directions(), v=vectors(), w_i=vectors(), w_j=vectors(), slip=vectors(0.1), turn=vectors(0.1))
def test_one_step_adds_the_increments_of_the_paper(n, v, w_i, w_j, slip, turn):
    d = scale(LENGTH, n)
    before = strained(d, slip, turn)
    _, after, _ = step(moving(d, v, w_i, w_j), before)
    mean = scale(0.5, add(w_i, w_j))
    spun = cross(scale(dot(mean, n) * DT, n), across(slip, n))
    expected = add(add(across(slip, n), spun), scale(DT, across(sub(v, cross(mean, d)), n)))
    assert_close(in_space(after)[0], expected, 3.0 * DT**2, 1.0)
    spun = cross(scale(dot(mean, n) * DT, n), across(turn, n))
    assert_close(in_space(after)[1], add(add(turn, spun), scale(DT, sub(w_j, w_i))), 3.0 * DT**2, 1.0)
    assert after.twist == pytest.approx(dot(turn, n) + DT * dot(sub(w_j, w_i), n), abs=1e-15)


@settings(max_examples=40, deadline=None)
@given(n=directions(), w=directions(), slip=vectors(0.1), turn=vectors(0.1))
def test_a_strained_bond_that_turns_as_a_whole_takes_its_loads_with_it(n, w, slip, turn):
    """The carried frame turns with the bond, whatever the angle between its axis and that of the turn."""
    steps, d, state = 16, scale(LENGTH, n), strained(scale(LENGTH, n), slip, turn)
    expected = [rotate(rotation(w, 1.0), a) for a in step(moving(d), state)[2]]
    for _ in range(steps):
        old, d = d, rotate(rotation(w, 1.0 / steps), d)
        _, state, ends = step(carried(old, d, w, 1.0 / steps), state, 1.0 / steps)
    assert np.abs(np.subtract(ends, expected)).max() < 1e-9


@settings(max_examples=30, deadline=None)
@given(n=directions(), around=directions(), w_i=vectors(), w_j=vectors())
def test_the_sums_converge_quadratically_while_the_bond_swings_and_its_ends_turn(n, around, w_i, w_j):
    """Twice the steps, a quarter of the error; the ends turn apart at changing rates while the bond turns and grows."""

    def place(t: float) -> Vec:
        return scale(LENGTH * (1.0 + 0.2 * math.sin(3.0 * t)), rotate(rotation(around, t), n))

    def sums(steps: int) -> np.ndarray:
        dt, state = 1.0 / steps, fresh(place(0.0))
        for k in range(steps):
            rates = [scale(math.cos(2.0 * (k + 0.5) * dt), w) for w in (w_i, w_j)]
            v = scale(steps, sub(place((k + 1) * dt), place(k * dt)))
            _, state, _ = step(moving(place((k + 1) * dt), v, *rates), state, dt)
        return np.array(in_space(state))

    exact = (4.0 * sums(512) - sums(256)) / 3.0
    coarse, fine = (np.abs(sums(steps) - exact).max() for steps in (32, 64))
    assert fine <= coarse / 3.5 + 1e-9


@settings(max_examples=40, deadline=None)
@given(n=directions(), v=vectors(), w_i=vectors(), w_j=vectors())
def test_small_strains_agree_with_total_kinematics(n, v, w_i, w_j):
    """The two differ by second-order terms: a tenth of the motion, about a hundredth of the difference."""
    d0 = scale(LENGTH, n)

    def difference(amount: float, steps: int = 8) -> float:
        state, dt = fresh(d0), amount / steps
        for k in range(1, steps + 1):
            _, state, _ = step(moving(add(d0, scale(k * dt, v)), v, w_i, w_j), state, dt)
        ends = step(moving(add(d0, scale(amount, v))), state, 0.0)[2]
        turned = [rotation(*axis_angle(scale(amount, w))) for w in (w_i, w_j)]
        motion = BondMotion(add(d0, scale(amount, v)), *turned, REST, REST, REST)
        strain, frame, _ = total.measure(motion, total.Reference(n, LENGTH), None, 0.0)
        return float(np.abs(np.subtract(ends, total.end_loads(stiff(strain), frame))).max())

    assert difference(1e-2) < 40.0 * 1e-4
    assert difference(1e-3) < 40.0 * 1e-6


def axis_angle(a: Vec) -> tuple[Vec, float]:
    angle = math.sqrt(dot(a, a))
    return (scale(1.0 / angle, a) if angle > 0.0 else (1.0, 0.0, 0.0)), angle


@settings(max_examples=60, deadline=None)
@given(
    n=directions(),
    v=vectors(),
    w_i=vectors(),
    w_j=vectors(),
    slip=vectors(0.1),
    turn=vectors(0.1),
    q=rotations(),
)
def test_a_rotated_world_gives_rotated_loads(n, v, w_i, w_j, slip, turn, q):
    d = scale(LENGTH, n)
    here = step(moving(d, v, w_i, w_j), strained(d, slip, turn))[2]
    rotated = [rotate(q, a) for a in (d, v, w_i, w_j, slip, turn)]
    there = step(moving(*rotated[:4]), strained(rotated[0], *rotated[4:]))[2]
    for a, b in zip(there, here, strict=True):
        assert_turned(a, b, q, 1.0, 1e-13)


@settings(max_examples=60, deadline=None)
@given(n=directions(), v=vectors(), w_i=vectors(), w_j=vectors(), slip=vectors(0.1), turn=vectors(0.1))
def test_swapping_the_ends_mirrors_the_loads_to_the_bit(n, v, w_i, w_j, slip, turn):
    d = scale(LENGTH, n)
    here, there = strained(d, slip, turn), strained(negated(d), negated(slip), negated(turn))
    for _ in range(3):
        d = add(d, scale(DT, v))
        _, here, ends = step(moving(d, v, w_i, w_j), here)
        _, there, mirrored = step(moving(negated(d), negated(v), w_j, w_i), there)
        assert mirrored == EndLoads(negated(ends.force), ends.moment_j, ends.moment_i)


@settings(max_examples=60, deadline=None)
@given(n=directions(), v=vectors(), w_i=vectors(), w_j=vectors(), slip=vectors(0.1), turn=vectors(0.1))
def test_a_bond_neither_pushes_nor_turns_the_pair_as_a_whole(n, v, w_i, w_j, slip, turn):
    d = scale(LENGTH, n)
    force, moment_i, moment_j = step(moving(d, v, w_i, w_j), strained(d, slip, turn))[2]
    assert_close(add(add(moment_i, moment_j), cross(d, force)), REST, 1e-14, 1.0)
