"""Walls that no step can follow are told before the run; what cannot be trusted from the start leaves nothing."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from clast import Simulation, run_scene
from clast.config.scene import SceneConfig, from_mapping
from clast.errors import PluginError, RefusedError, RunError
from clast.forecast import forecast
from clast.soundness.swift_walls import swift_walls

RADIUS = 1e-3


def pressed(**motion: Any) -> SceneConfig:
    """Return one sphere between a floor and a plate that moves."""
    plate = {"type": "plane", "material": "glass", "point": [0, 0, 3e-3], "normal": [0, 0, -1], "motion": motion}
    return from_mapping(
        {
            "materials": {"glass": {"density": 2500.0, "young_modulus": 5e7, "poisson_ratio": 0.2}},
            "particles": {
                "type": "explicit",
                "material": "glass",
                "particles": [{"position": [0, 0, RADIUS], "radius": RADIUS}],
            },
            "contacts": {"law": "hertz_mindlin", "pairs": {"default": {"restitution": 0.5}}},
            "walls": {
                "plate": plate,
                "floor": {"type": "plane", "material": "glass", "point": [0, 0, 0], "normal": [0, 0, 1]},
            },
            "time": {"end": {"time": 1e-3}},
            "output": {"writers": []},
        }
    )


@pytest.mark.parametrize(
    "motion",
    [
        {"type": "constant_velocity", "velocity": [0, 0, -200.0]},
        {"type": "velocity_ramp", "end": [0, 0, -200.0], "duration": 5e-4},
        {"type": "free", "mass": 1e-3, "velocity": [0, 0, -200.0]},
    ],
)
def test_a_wall_that_outruns_its_contacts_is_told_with_a_step_that_would_do(motion: dict[str, Any]) -> None:
    (text,) = [each for each in forecast(pressed(**motion)).concerns if "walls.plate" in each]
    assert "times the smallest radius: it passes through particles" in text
    step = float(text.split("time.step below ")[1].split(" s")[0])
    assert swift_walls(pressed(**motion), RADIUS, 0.9 * step, 1000) == []


def test_walls_that_contacts_can_follow_are_not_remarked_on() -> None:
    slow = pressed(type="constant_velocity", velocity=[0, 0, -1.0])
    assert [each for each in forecast(slow).concerns if "walls.plate" in each] == []


def test_what_cannot_be_trusted_from_the_start_is_refused_and_leaves_no_folder(tmp_path: Path) -> None:
    with pytest.raises(RefusedError, match="cannot be trusted from its start on: particle 0 and the wall 'plate'"):
        run_scene(pressed(type="constant_velocity", velocity=[0, 0, -1e5]), tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_a_run_that_cannot_be_trusted_any_more_keeps_its_results(tmp_path: Path) -> None:
    with pytest.raises(RunError, match=r"stopped at step \d+ .*let bodies meet more slowly") as stopped:
        run_scene(pressed(type="constant_velocity", velocity=[0, 0, -150.0]), tmp_path / "run")
    assert stopped.value.exit_code == 1
    assert (tmp_path / "run" / "results.h5").exists()


def test_a_wall_that_turns_too_far_in_a_step_is_told() -> None:
    for motion in (
        {"type": "rotation", "axis": [0, 0, 1], "point": [0, 0, 3e-3], "rate": 1e6},
        {"type": "swing", "axis": [0, 0, 1], "point": [0, 0, 3e-3], "amplitude": 1.0, "frequency": 1e6},
    ):
        (text,) = [each for each in forecast(pressed(**motion)).concerns if "walls.plate" in each]
        assert "rad in a step of" in text
    slow = pressed(type="rotation", axis=[0, 0, 1], point=[0, 0, 3e-3], rate=10.0)
    assert [each for each in forecast(slow).concerns if "walls.plate" in each] == []


def test_a_law_that_raises_amid_a_run_ends_it_as_any_failure_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def boom(simulation: Simulation, observers: object) -> None:
        raise PluginError("law.py:3: raised ValueError: boom")

    monkeypatch.setattr(Simulation, "run", boom)
    with pytest.raises(RunError, match=r"law\.py:3: raised ValueError: boom") as failed:
        run_scene(pressed(type="constant_velocity", velocity=[0, 0, -1.0]), tmp_path / "run")
    assert failed.value.exit_code == 1
    assert (tmp_path / "run" / "checkpoint.h5").exists()
