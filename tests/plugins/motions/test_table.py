"""A table of displacements or velocities: what it says between its rows and after them, and what it refuses."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast.config.scene import load
from clast.errors import ConfigError
from clast.scene.compression import Gauge
from clast_plugins.motions.table import Course, Table, course, place, velocity
from tests.scenes import CRUSH, write

UP = (0.0, 0.0, 2.0)
ROWS = ((0.0, 0.5), (1.0, 2.0), (1.5, 1.0), (4.0, 0.5))


def table(kind: str = "displacement", **settings: Any) -> Course:
    return course(Table(direction=UP, **{kind: ROWS}, **settings))


@settings(max_examples=30, deadline=None)
@given(st.floats(0.0, 9.0))
def test_displacements_are_joined_by_straight_lines_and_the_last_one_holds(time: float) -> None:
    assert place(table(), time) == pytest.approx(np.interp(time, *np.array(ROWS).T) - 0.5, abs=1e-12)
    assert place(table(after="repeat"), time) == pytest.approx(
        np.interp(time, *np.array(ROWS).T, period=4.0) - 0.5, abs=1e-12
    )


@settings(max_examples=30, deadline=None)
@given(st.floats(0.0, 9.0))
def test_velocities_are_joined_by_straight_lines_and_the_last_one_is_kept(time: float) -> None:
    assert velocity(table("velocity"), time)[2] == pytest.approx(np.interp(time, *np.array(ROWS).T), abs=1e-12)
    again = velocity(table("velocity", after="repeat"), time)[2]
    assert again == pytest.approx(np.interp(time % 4.0, *np.array(ROWS).T), abs=1e-12)


@settings(max_examples=30, deadline=None)
@given(st.floats(0.0, 4.0))
def test_smooth_pieces_go_through_the_rows_and_never_beyond_their_neighbours(time: float) -> None:
    smooth, rows = table(between="smooth"), np.array(ROWS)
    k = int(np.clip(np.searchsorted(rows[:, 0], time), 1, 3))
    low, high = sorted(rows[k - 1 : k + 1, 1] - 0.5)
    assert low - 1e-12 <= place(smooth, time) <= high + 1e-12
    for t, value in ROWS:
        assert place(smooth, t) == pytest.approx(value - 0.5, abs=1e-12)
        before, after = (velocity(smooth, t + side * 1e-9)[2] for side in (-1, 1))
        assert t in (0.0, 4.0) or before == pytest.approx(after, abs=1e-6)


def test_a_file_with_units_in_its_header_says_the_same_as_its_rows_in_si(tmp_path: Path) -> None:
    lines = ["time [ms], force_N, displacement [mm]", *(f"{1e3 * t},7,{1e3 * x}" for t, x in ROWS)]
    (tmp_path / "course.csv").write_text("\n".join(lines))
    (tmp_path / "same.csv").write_text("\n".join(["time_s,displacement_m", *(f"{t},{x}" for t, x in ROWS)]))
    for name in ("course.csv", "same.csv"):
        found = course(Table(direction=UP, file=tmp_path / name))
        assert found.pieces == pytest.approx(table().pieces, abs=1e-12)
    crush = write(tmp_path, CRUSH)
    scene = load(crush, ["walls.upper.motion={type: table, direction: [0, 0, -1], file: course.csv}"])
    assert scene.resolved()["walls"]["upper"]["motion"]["file"] == str((tmp_path / "course.csv").resolve())


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("time,displacement [mm]\n0,0", r"course.csv:1: the header holds displacement; a time and either"),
        ("time [ms],velocity [mm]\n0,0", r"course.csv:1: column 'velocity \[mm\]': '1 mm' is a length"),
        ("time [ms],velocity [m/s]\n0,0\n1,fast", r"course.csv:3: velocity \[m/s\] is 'fast', not a number"),
        ("time [ms],velocity [m/s]\n0,0\n1", r"course.csv:3: velocity \[m/s\] is missing"),
        ("time [s],velocity [m/s]\n0,0\n2,1\n2,1", r"course.csv: times must rise from row to row; row 3 is at 2 s"),
        ("time [s],velocity [m/s]\n1,0\n2,1", r"course.csv: the first row must be at the time 0; given 1 s"),
        ("time [s],velocity [m/s]\n0,0", r"course.csv: at least two rows are needed; given 1"),
        (None, r"course.csv: there is no such file"),
    ],
)
def test_a_file_that_is_no_course_is_refused_with_its_line(tmp_path: Path, text: str | None, told: str) -> None:
    if text is not None:
        (tmp_path / "course.csv").write_text(text)
    crush = write(tmp_path, CRUSH)
    with pytest.raises(ConfigError, match=told) as error:
        load(crush, ["walls.upper.motion={type: table, direction: [0, 0, -1], file: course.csv}"])
    assert "walls.upper.motion" in str(error.value)


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        ({}, "exactly one of displacement, velocity and file is needed; given none of them"),
        ({"displacement": [[0, 0], [1, 1]], "velocity": [[0, 0], [1, 1]]}, "given displacement and velocity"),
        ({"displacement": [[0, 0], [1, 1]], "after": "repeat"}, "must end where it begins; given 0 m at first and 1 m"),
    ],
)
def test_what_does_not_go_together_is_refused(settings: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=told):
        Table.model_validate({"direction": UP, **settings})


def test_a_scene_that_lasts_longer_than_a_table_that_shall_not_end_is_refused(tmp_path: Path) -> None:
    rows = "displacement: [[0, 0], [10 ms, 1 mm]]"
    crush = write(tmp_path, CRUSH)
    motion = "walls.upper.motion={type: table, direction: [0, 0, -1], %s, after: %s}"
    for after, end, fine in (("refuse", 0.01, True), ("refuse", 0.02, False), ("hold", 0.02, True)):
        scene = load(crush, [motion % (rows, after), f"time.end={{time: {end}}}"])
        if fine:
            assert Gauge(scene).last_step(1e-6) == round(end / 1e-6)
        else:
            with pytest.raises(ConfigError, match=r"walls.upper.motion: tells how the wall moves for 0.01 s only"):
                Gauge(scene).last_step(1e-6)
