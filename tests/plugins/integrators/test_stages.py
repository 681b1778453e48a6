"""Integrators: kicks and drifts of a whole step, order, and how far damping shrinks the stable step."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from scipy.linalg import expm

from clast.parts.integrator import Integrator
from clast.plugins.discovery import discover
from tests.support.strategies import numbers

each = pytest.mark.parametrize("name", discover().names("integrator"))


def part(name: str) -> Integrator:
    return discover().get("integrator", name).part


def amplification(scheme: Integrator, h: float, zeta: float) -> np.ndarray:
    """Return what one step of length h does to (x, v, a) of x'' = −x − 2ζ x'."""
    step = np.eye(3)
    for stage in scheme.stages:
        kick_before, drift_before, kick_after, drift_after = np.eye(3), np.eye(3), np.eye(3), np.eye(3)
        kick_before[1, 2] = stage.kick_before * h
        drift_before[0, 1] = stage.drift_before * h
        forces = np.array([[1, 0, 0], [0, 1, 0], [-1.0, -2.0 * zeta, -2.0 * zeta * stage.predict * h]])
        kick_after[1, 2] = stage.kick_after * h
        drift_after[0, 1] = stage.drift_after * h
        step = drift_after @ kick_after @ forces @ drift_before @ kick_before @ step
    return step


def radius(scheme: Integrator, h: float, zeta: float) -> float:
    return float(np.abs(np.linalg.eigvals(amplification(scheme, h, zeta))).max())


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
def test_without_damping_nothing_is_gained_or_lost_up_to_two_over_omega(name):
    scheme = part(name)
    assert scheme.damping_factor(0.0) == 1.0
    for h in (0.1, 1.0, 1.9):
        moves = np.linalg.eigvals(amplification(scheme, h, 0.0))
        assert np.sort(np.abs(moves))[-2:] == pytest.approx([1.0, 1.0], abs=1e-12)
    assert radius(scheme, 2.01, 0.0) > 1.0


def slope(name: str, zeta: float, row: int) -> float:
    """Return the observed order of one component after a unit of time, from steps 1/40 and 1/80."""
    scheme, exact = part(name), expm(np.array([[0.0, 1.0], [-1.0, -2.0 * zeta]])) @ np.array([1.0, 0.3])
    errors = []
    for steps in (40, 80):
        state = np.array([1.0, 0.3, -1.0 - 0.6 * zeta])
        if name == "leapfrog":
            state[1] -= 0.5 / steps * state[2]
        state = np.linalg.matrix_power(amplification(scheme, 1.0 / steps, zeta), steps) @ state
        errors.append(abs(state[row] - exact[row]))
    return float(np.log2(errors[0] / errors[1]))


@each
def test_positions_are_of_the_promised_order_where_forces_depend_on_positions_alone(name):
    assert slope(name, 0.0, row=0) == pytest.approx(part(name).order, abs=0.1)


def test_midstep_alone_keeps_its_order_with_damping():
    assert slope("midstep", 0.3, row=0) == pytest.approx(2.0, abs=0.1)
    for lagging in ("leapfrog", "velocity_verlet"):
        assert slope(lagging, 0.3, row=0) == pytest.approx(1.0, abs=0.15)


def test_leapfrog_s_extra_kick_is_half_a_step_and_the_others_have_none():
    leapfrog = part("leapfrog")
    assert leapfrog.start_kick(leapfrog.Params()) == 0.0
    assert leapfrog.start_kick(leapfrog.Params(start_kick=True)) == 0.5
    assert all(part(name).start_kick(part(name).Params()) == 0.0 for name in ("midstep", "velocity_verlet"))
