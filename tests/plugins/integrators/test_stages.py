"""Integrators: kicks and drifts of a whole step, order, and how far damping shrinks the stable step."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.linalg import expm

from clast.parts.integrator import Integrator, amplification, stable_share
from clast.plugins.discovery import discover
from clast.stability.damped_step import ACCURACY, stable_step
from tests.support.strategies import numbers

each = pytest.mark.parametrize("name", discover().names("integrator"))


def part(name: str) -> Integrator:
    return discover().get("integrator", name).part


def matrix(scheme: Integrator, h: float, zeta: float) -> np.ndarray:
    """Return what one step of length h does to (x, v, a) of x'' = −x − 2ζ x'."""
    return amplification(scheme.stages, np.array([h]), zeta)[0]


def radius(scheme: Integrator, h: float, zeta: float) -> float:
    return float(np.abs(np.linalg.eigvals(matrix(scheme, h, zeta))).max())


@each
def test_the_kicks_and_the_drifts_of_a_step_each_add_up_to_one(name):
    stages = part(name).stages
    assert sum(stage.kick_before + stage.kick_after for stage in stages) == 1.0
    assert sum(stage.drift_before + stage.drift_after for stage in stages) == 1.0


@each
@settings(max_examples=60, deadline=None)
@given(zeta=numbers(0.001, 3.0))
def test_a_damped_oscillator_is_stable_up_to_the_promised_step_and_no_further(name, zeta):
    scheme = part(name)
    limit = 2.0 * scheme.damping_factor(zeta)
    assert radius(scheme, 0.9999 * limit, zeta) <= 1.0 + 1e-12
    assert radius(scheme, 1.0001 * limit, zeta) > 1.0


@each
@settings(max_examples=30, deadline=None)
@given(zeta=numbers(0.0, 3.0), share=numbers(0.01, 0.999))
def test_it_is_stable_at_every_smaller_step_too(name, zeta, share):
    scheme = part(name)
    assert radius(scheme, share * 2.0 * scheme.damping_factor(zeta), zeta) <= 1.0 + 1e-9


@each
def test_without_damping_nothing_is_gained_or_lost_up_to_the_limit(name):
    scheme = part(name)
    limit = 2.0 * scheme.damping_factor(0.0)
    for h in (0.05 * limit, 0.5 * limit, 0.95 * limit):
        moves = np.linalg.eigvals(matrix(scheme, h, 0.0))
        assert np.sort(np.abs(moves))[-2:] == pytest.approx([1.0, 1.0], abs=1e-12)
    assert radius(scheme, 1.005 * limit, 0.0) > 1.0


@each
def test_schemes_of_one_evaluation_are_stable_up_to_two_over_omega_and_none_goes_further_for_each(name):
    share = part(name).damping_factor(0.0) / len(part(name).stages)
    assert share == 1.0 if len(part(name).stages) == 1 else share < 1.0


@each
@settings(max_examples=20, deadline=None)
@given(zeta=numbers(0.001, 3.0))
def test_the_promised_step_is_the_one_found_from_the_stages(name, zeta):
    scheme = part(name)
    assert stable_share(scheme.stages, zeta) == pytest.approx(scheme.damping_factor(zeta), rel=1e-5)


@each
@settings(max_examples=30, deadline=None)
@given(spring=numbers(0.001, 1.0), zeta=numbers(0.0, 3.0))
def test_the_step_of_many_springs_is_never_above_that_of_one_of_them(name, spring, zeta):
    """The fastest of several oscillators that share nothing decides; each is stable with the step found for all."""
    scheme = part(name)
    squares, drags = np.array([1.0, spring]), np.array([0.0, 2.0 * zeta * np.sqrt(spring)])
    step = stable_step(lambda per_time: float((squares + drags * per_time).max()), scheme.damping_factor)
    shares = [0.5 * step, 0.5 * step * np.sqrt(spring)]
    assert shares[0] <= scheme.damping_factor(0.0) * (1.0 + 1e-9)
    assert shares[1] <= scheme.damping_factor(zeta) * (1.0 + ACCURACY)


def slope(name: str, zeta: float, row: int) -> float:
    """Return the observed order of one component after a unit of time, from one step and its half."""
    scheme, exact = part(name), expm(np.array([[0.0, 1.0], [-1.0, -2.0 * zeta]])) @ np.array([1.0, 0.3])
    errors = []
    for steps in (10, 20) if scheme.order > 2 else (40, 80):
        state = np.array([1.0, 0.3, -1.0 - 0.6 * zeta])
        if name == "leapfrog":
            state[1] -= 0.5 / steps * state[2]
        state = np.linalg.matrix_power(matrix(scheme, 1.0 / steps, zeta), steps) @ state
        errors.append(abs(state[row] - exact[row]))
    return float(np.log2(errors[0] / errors[1]))


@each
def test_positions_are_of_the_promised_order_where_forces_depend_on_positions_alone(name):
    assert slope(name, 0.0, row=0) == pytest.approx(part(name).order, abs=0.1)


def test_midstep_alone_keeps_its_order_with_damping():
    assert slope("midstep", 0.3, row=0) == pytest.approx(2.0, abs=0.1)
    for lagging in set(discover().names("integrator")) - {"midstep"}:
        assert slope(lagging, 0.3, row=0) == pytest.approx(1.0, abs=0.15)


def walk(name: str, x: float, v: float, h: float, steps: int) -> list[tuple[float, float]]:
    """Return x and v after each step of x'' = −x − x³."""
    seen = []
    for _ in range(steps):
        for stage in part(name).stages:
            x += stage.drift_before * h * v
            v += stage.kick_after * h * (-x - x**3)
            x += stage.drift_after * h * v
        seen.append((x, v))
    return seen


def test_symplectic_euler_is_leapfrog_started_half_a_step_off_to_the_bit():
    x, v, h = 1.0, 0.3, 0.1
    euler, leapfrog = walk("symplectic_euler", x, v, h, 50), walk("leapfrog", x + h * v, v, h, 50)
    assert [each[1] for each in euler] == [each[1] for each in leapfrog]
    assert [each[0] for each in euler[1:]] == [each[0] for each in leapfrog[:-1]]


def test_leapfrog_s_extra_kick_is_half_a_step_and_the_others_have_none():
    leapfrog = part("leapfrog")
    assert leapfrog.start_kick(leapfrog.Params()) == 0.0
    assert leapfrog.start_kick(leapfrog.Params(start_kick=True)) == 0.5
    others = set(discover().names("integrator")) - {"leapfrog"}
    assert all(part(name).start_kick(part(name).Params()) == 0.0 for name in others)
