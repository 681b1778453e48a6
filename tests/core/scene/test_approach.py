"""When a wall has come a distance, however its velocity changes."""

from __future__ import annotations

from math import pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast.scene.approach import time_of


@given(st.floats(1e-6, 1e3), st.floats(1e-9, 1e2))
def test_at_a_constant_velocity_it_is_distance_over_velocity_to_the_bit(speed: float, distance: float) -> None:
    assert time_of(lambda t: speed, distance) == (distance / speed, distance)


@given(st.floats(1e-6, 1e3), st.floats(1e-6, 1e2), st.floats(-1.0, 0.9))
def test_a_linear_change_ends_where_its_parabola_does(acceleration: float, time: float, start: float) -> None:
    """The start is a share of the velocity at the end, down to a wall that first moves away."""
    begin = start * acceleration * time
    distance = begin * time + 0.5 * acceleration * time**2
    if distance > 1e-3 * acceleration * time**2:
        assert time_of(lambda t: begin + acceleration * t, distance).time == pytest.approx(time, rel=1e-6)


def test_a_velocity_that_comes_and_goes_is_followed_to_its_first_arrival() -> None:
    found = time_of(lambda t: 2.0 * pi * sin(2.0 * pi * t), 1.0)  # way: 1 − cos(2 π t)
    assert found.time == pytest.approx(0.25, rel=1e-9)


def test_a_velocity_that_begins_late_is_found() -> None:
    assert time_of(lambda t: 1.0 if t > 0.3 else 0.0, 0.5).time == pytest.approx(0.8, rel=1e-6)


def test_what_is_never_reached_is_told_with_how_far_it_comes() -> None:
    assert time_of(lambda t: max(2.0 - t, 0.0), 3.0) == (None, pytest.approx(2.0, rel=1e-6))
    assert time_of(lambda t: -1.0, 1.0) == (None, 0.0)
