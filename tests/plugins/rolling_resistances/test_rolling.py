"""Rolling resistances: the contract of their kind, and what each of them promises."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

from clast.config.examples import example
from clast.maths.vec3 import across, add, cross, dot, norm, scale, sub
from clast.parts.rolling_resistance import Pressing
from clast.plugins.discovery import discover
from clast.testing.contacts import DT, GLASS, MASS, RADIUS, resting, touches
from clast.testing.kit import try_part
from clast.testing.rolling_resistance import Rolling, turning
from clast_plugins.rolling_resistances.constant_torque import BRAKING_STEPS
from tests.support.strategies import assert_close, negated, numbers

REGISTRY = discover()


def rolling(name: str, mu: float = 0.05, **written) -> Rolling:
    part = REGISTRY.get("rolling_resistance", name).part
    params = example(part.Params, written)
    return Rolling(part, part.constants(params, GLASS._replace(rolling_friction=mu)), part.choices(params))


def answer(bound: Rolling, touch, limit: float, history=None, dt: float = DT):
    pressing = Pressing(limit, 5e4, 5e4)
    return bound.part.load(touch, bound.constants, history or bound.fresh, pressing, dt, bound.choices)


@pytest.mark.parametrize("name", REGISTRY.names("rolling_resistance"))
def test_a_rolling_resistance_keeps_to_the_contract_of_its_kind(name):
    tried = try_part(REGISTRY.get("rolling_resistance", name))
    assert [f"{each.says}: {each.problem}" for each in tried if each.problem] == []


@settings(max_examples=60, deadline=None)
@given(touch=touches(), mu=numbers(0.01, 1.0), limit=numbers(1e-6, 10.0))
def test_a_constant_torque_slows_the_rolling_and_never_reverses_it(touch, mu, limit):
    told, _ = answer(rolling("constant_torque", mu), touch, limit)
    assert told.torque_i == negated(told.torque_j)
    relative = across(sub(touch.spin_j, touch.spin_i), touch.normal)
    after = add(relative, scale(touch.inverse_inertia * DT, told.torque_j))
    assert dot(told.torque_j, relative) <= 0.0
    assert dot(after, relative) >= -1e-12 * dot(relative, relative)
    assert_close(cross(told.torque_j, relative), (0.0, 0.0, 0.0), 1e-12, norm(told.torque_j) * norm(relative) + 1e-300)
    stopping = norm(relative) / (BRAKING_STEPS * touch.inverse_inertia * DT)
    assert norm(told.torque_i) == pytest.approx(min(mu * limit * touch.radius, stopping), rel=1e-12, abs=1e-300)


@settings(max_examples=40, deadline=None)
@given(touch=touches())
def test_a_constant_torque_by_own_spin_acts_against_each_particle_s_own_spin(touch):
    told, _ = answer(rolling("constant_torque", spin="own"), touch, 2.0)
    for torque, spin, radius in (
        (told.torque_i, touch.spin_i, touch.radius_i),
        (told.torque_j, touch.spin_j, touch.radius_j),
    ):
        size = 0.05 * 2.0 * radius
        expected = scale(-size / norm(spin), spin) if norm(spin) > 0.0 else (0.0, 0.0, 0.0)
        assert_close(torque, expected, 1e-12, size + 1e-300)


def rolled(bound: Rolling, angles, limit: float, dt: float):
    """Return the torques on j while it turns about x against i by some angles, one after the other."""
    history, found, before = None, [], 0.0
    for angle in angles:
        spin = ((angle - before) / dt, 0.0, 0.0)
        told, history = answer(bound, turning(resting(0.01 * RADIUS)._replace(spin_j=spin), dt), limit, history, dt)
        found.append(told.torque_j[0])
        before = angle
    return found


def test_the_elastic_plastic_torque_winds_up_yields_and_unwinds():
    """k_r = s k_n (mu R*)^2 up to mu F R*; turned back by twice the elastic angle it is full the other way."""
    mu, limit, half = 0.1, 0.02, 0.5 * RADIUS
    bound = rolling("elastic_plastic", mu, stiffness=3.0, damping=0.0)
    k = 3.0 * 5e4 * (mu * half) ** 2
    full = mu * limit * half
    path = [0.5 * full / k, full / k, 2.0 * full / k, 1.5 * full / k, 0.5 * full / k, -full / k, 0.0]
    expected = [-0.5, -1.0, -1.0, -0.5, 0.5, 1.0, 0.0]
    assert rolled(bound, path, limit, 1e-3) == pytest.approx(
        [full * share for share in expected], rel=1e-9, abs=1e-12 * full
    )


def test_the_dashpot_of_the_rolling_spring_has_the_damping_ratio_that_is_written():
    """A sphere that rolls on its contact point: inertia 7/2 I*, spring k_r; c = 2 eta sqrt(7/2 I* k_r)."""
    mu, eta, half, rate = 0.1, 0.3, 0.5 * RADIUS, 1e-3
    bound = rolling("elastic_plastic", mu, damping=eta)
    k, inertia = 2.25 * 5e4 * (mu * half) ** 2, 0.2 * MASS * RADIUS**2
    (torque,) = rolled(bound, [rate * 1e-12], 1.0, 1e-12)
    assert -torque == pytest.approx(2.0 * eta * (3.5 * inertia * k) ** 0.5 * rate + k * rate * 1e-12, rel=1e-9)
