"""The small oedometer, as a new user meets it: fill, press, look."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from clast import load, open_run, run_scene

SCENE = Path(__file__).parents[2] / "configs" / "oedometer_small.yaml"
STRAIN = 0.02


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("oedometer") / "run"
    run_scene(load(SCENE).changed({"time.end": {"strain": STRAIN}, "output.frames": 2, "output.samples": 20}), made)
    return made


def test_every_grain_is_there_from_start_to_end(folder: Path) -> None:
    with open_run(folder) as run:
        assert run.grain.max() + 1 == 60
        first, last = run.frame(0), run.frame(-1)
    assert np.isfinite(last.position).all()
    out = np.hypot(last.position[:, 0], last.position[:, 1]) + run.radius
    assert out.max() < 7.1e-3
    assert (last.position[:, 2] - run.radius).min() > -0.1e-3
    assert last.position[:, 2].max() < first.position[:, 2].max()


def test_the_piston_presses_on_the_bottom_and_the_tube(folder: Path) -> None:
    with open_run(folder) as run:
        upper, lower = run.curves["force_upper_N"][-1], run.curves["force_lower_N"][-1]
        assert upper > 0.0
        assert lower > 0.0
        assert run.curves["normal_force_tube_N"][-1] > 0.0


def test_the_summary_tells_of_grains_and_of_the_fill(folder: Path) -> None:
    told = json.loads((folder / "summary.json").read_text())
    assert told["counts"]["grains"] == 60
    assert sum(told["grains"][state] for state in ("intact", "damaged", "crushed")) == 60
    assert any("bulk_density_kg_per_m3" in each for each in told["generators"].values())
