"""Every motion can be tried; a swing is one; what is free obeys Newton."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from scipy.integrate import quad

from clast.config.examples import example
from clast.parts.motion import Motion, Pressed
from clast.plugins.discovery import discover
from clast.testing.kit import try_part
from tests.support.strategies import numbers, vectors


def part(name: str) -> Motion:
    return discover().get("motion", name).part


@pytest.mark.parametrize("name", discover().names("motion"))
def test_it_keeps_to_what_holds_for_every_motion(name):
    outcomes = try_part(discover().get("motion", name))
    assert [outcome for outcome in outcomes if not outcome.passed] == []


@settings(max_examples=30, deadline=None)
@given(phase=numbers(0.0, 0.99), time=numbers(0.0, 0.05))
def test_a_swing_has_come_as_far_as_its_sine_says(phase, time):
    motion = part("sinusoid")
    course = motion.course(example(motion.Params, {"amplitude": [0, 0.003, 0], "frequency": 50, "phase": phase}))
    way, _ = quad(lambda t: motion.velocity(course, t)[1], 0.0, time, limit=200)
    turn = 2.0 * math.pi * phase
    expected = 0.003 * (math.sin(100.0 * math.pi * time + turn) - math.sin(turn))
    assert way == pytest.approx(expected, abs=1e-9)


@settings(max_examples=30, deadline=None)
@given(push=vectors(), velocity=vectors(), span=numbers(1e-6, 1e-3), since=numbers(0.0, 1e-3))
def test_what_is_free_changes_its_momentum_by_the_forces_and_only_along_its_way(push, velocity, span, since):
    motion = part("free")
    course = motion.course(
        example(motion.Params, {"mass": 2.0, "gravity": [0, 0, -9.81], "force": [0, 0, 4.0], "along": [0, 0, 5]})
    )
    found = motion.answer(course, 0.0, Pressed(push, 1.0, (0.0, 0.0, velocity[2]), span, since))
    assert found[:2] == (0.0, 0.0)
    gained = 2.0 * (found[2] - velocity[2])
    assert gained == pytest.approx(0.5 * (span + since) * (push[2] + 4.0 - 2.0 * 9.81), abs=1e-12)


def test_a_free_wall_starts_with_its_velocity_and_leaves_less_of_the_step_the_lighter_it_is():
    motion = part("free")
    course = motion.course(example(motion.Params, {"mass": 0.3, "velocity": [1, 2, 3]}))
    assert motion.start(course) == (1.0, 2.0, 3.0)
    assert motion.step_share(course, 0.1, math.inf) == pytest.approx(math.sqrt(0.75))
    assert motion.step_share(course, 0.0, math.inf) == 1.0
