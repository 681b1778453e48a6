"""A ramp of velocity: what it says, where it brings the wall, and when a compression by one ends."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast import Simulation, load
from clast.errors import ConfigError
from clast_plugins.motions.velocity_ramp import Course, VelocityRamp, course, velocity
from tests.scenes import CRUSH, write

RAMP = "walls.upper.motion={type: velocity_ramp, start: [0, 0, %s], end: [0, 0, %s], duration: %s, shape: %s}"
LEDGER = "output.ledger=true"
UP, DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -3.0)


def simulation(folder: Path, *settings: Any) -> Simulation:
    return Simulation(load(write(folder, CRUSH), [str(each) for each in settings]))


@given(st.floats(0.0, 10.0), st.sampled_from([0.0, 1.0]))
def test_the_velocity_lies_between_start_and_end_and_stays(time: float, smooth: float) -> None:
    ramp = Course(UP, DOWN, duration=4.0, smooth=smooth)
    v = velocity(ramp, time)[2]
    assert -3.0 <= v <= 1.0
    if time >= 4.0:
        assert v == -3.0
    assert velocity(ramp, 0.0)[2] == 1.0
    assert velocity(ramp, 2.0)[2] == pytest.approx(-1.0)


def test_a_smooth_ramp_begins_and_ends_without_a_jump_of_the_acceleration() -> None:
    smooth, linear = (course(VelocityRamp(end=DOWN, duration=1.0, shape=shape)) for shape in ("smooth", "linear"))
    for time in (0.0, 1.0):
        slope = abs(velocity(smooth, time + 1e-6)[2] - velocity(smooth, time - 1e-6)[2]) / 2e-6
        kink = abs(velocity(linear, time + 1e-6)[2] - velocity(linear, time - 1e-6)[2]) / 2e-6
        assert slope < 1e-4 < 1.4 < kink


def test_the_wall_comes_as_far_as_the_integral_of_its_velocity_with_the_square_of_the_step(tmp_path: Path) -> None:
    errors = []
    for step in (4e-7, 2e-7):
        rising = simulation(tmp_path, LEDGER, f"time.step={step}", RAMP % (0, "-10 mm/s", "1 ms", "smooth"))
        rising.advance_to(round(0.4e-3 / step))
        s = 0.4
        integral = -0.01 * 1e-3 * (s**3 - 0.5 * s**4)
        errors.append(abs(rising.world.walls.displacement[0, 2] - integral))
        rising.advance_to(round(1.5e-3 / step))
        assert rising.world.walls.displacement[0, 2] == pytest.approx(-0.01 * (0.5e-3 + 0.5e-3), rel=1e-9)
    assert errors[0] < 1e-6 * abs(integral)
    assert errors[0] == pytest.approx(4.0 * errors[1], rel=0.05)


@pytest.mark.parametrize("shape", ["smooth", "linear"])
@pytest.mark.parametrize(("start", "duration"), [("0", "2 ms"), ("-5 mm/s", "10 s"), ("5 mm/s", "1 ms")])
def test_a_strain_at_the_end_is_reached_however_the_velocity_changes(
    tmp_path: Path, start: str, duration: str, shape: str
) -> None:
    gauge = simulation(tmp_path, "time.end={strain: 0.002}", RAMP % (start, "-10 mm/s", duration, shape))
    gauge.advance_to(gauge.last_step - 1)
    before = gauge.gauge.strain(gauge.world.walls)
    gauge.advance_to(gauge.last_step)
    reached = gauge.gauge.strain(gauge.world.walls)
    assert before < 0.002 * (1 + 1e-6)
    assert reached == pytest.approx(0.002, abs=reached - before + 1e-9)


def test_a_ramp_that_stops_before_the_strain_is_refused_with_how_far_it_comes(tmp_path: Path) -> None:
    file = write(tmp_path, CRUSH)
    with pytest.raises(ConfigError) as told:
        Simulation(load(file, [RAMP % ("-10 mm/s", 0, "2 ms", "smooth")]))
    assert "time.end.strain: the plates do not approach each other by more than the strain 0.008333" in str(told.value)
    with pytest.raises(ConfigError, match=r"the plates do not approach each other; give walls.upper.motion a velocity"):
        Simulation(load(file, [RAMP % (0, "10 mm/s", "2 ms", "smooth")]))


def test_the_ledger_closes_while_the_velocity_changes(tmp_path: Path) -> None:
    loaded = simulation(
        tmp_path,
        LEDGER,
        "time.step=1e-7",
        "time.end={time: 6 ms}",
        RAMP % ("-20 mm/s", "0", "6 ms", "linear"),
    )
    loaded.advance_to(loaded.last_step)
    assert loaded.world.walls.force[0, 2] > 0.1
    assert abs(loaded.ledger().closure) < 1e-5
