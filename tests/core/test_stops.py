"""A run that a condition ends: what it leaves behind, and that it stays ended."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from clast import load, open_run, run_scene
from clast.errors import ConfigError
from clast.observer import Ended
from clast.results.in_words import summary_rows
from clast.results.stops import Stops
from clast.verification.bench import scene_file
from tests.scenes import COLLISION, write

REST = "stop=[{type: at_rest, limit: 1e-2}]"


def arrays(folder: Path) -> dict[str, bytes]:
    found: dict[str, bytes] = {}
    with h5py.File(folder / "results.h5") as file:
        file.visititems(
            lambda name, item: found.update({name: item[...].tobytes()}) if hasattr(item, "shape") else None
        )
    return found


def test_a_run_ends_at_the_sample_that_reaches_the_condition_with_a_last_frame_and_the_reason(tmp_path):
    scene = load(scene_file("damping_local"), [REST, "output.writers=[]", "output.frames=7"])
    outcome = run_scene(scene, tmp_path)
    with open_run(tmp_path) as run:
        ratio, time = run.curves["unbalanced_force_ratio"], run.curves["time_s"]
        assert run.frame(run.n_frames - 1).time == time[-1]
        assert time[-1] < 0.8 * scene.time.end.time
        assert ratio[-5:].max() < 1e-2
        assert all(ratio[k - 5 : k].max() >= 1e-2 for k in range(5, len(ratio)))
    assert outcome.summary["ended_by"]["by"] == "at_rest"
    told = dict(summary_rows(outcome.summary))
    assert told["ended by at_rest"].startswith("at rest: unbalanced forces are 0.00")
    before = arrays(tmp_path)
    run_scene(scene, tmp_path, resume=True)
    assert arrays(tmp_path) == before


class Running:
    """Stands for a simulation that a condition ends."""

    ended: Ended | None = None

    def end_here(self, ended: Ended) -> None:
        self.ended = ended


def test_samples_from_before_a_resume_count(tmp_path):
    scene = load(write(tmp_path, COLLISION), ["stop=[{type: bonds_broken, share: 0.5}]"])
    whole, resumed = Running(), Running()
    rows = [{"bonds_broken": float(k), "bonds_intact": 4.0 - k} for k in range(3)]
    first, second = Stops(scene), Stops(scene)
    for row in rows:
        first.look(whole, row)
    second.recall({name: np.array([row[name] for row in rows[:2]]) for name in rows[0]})
    second.look(resumed, rows[2])
    assert whole.ended == resumed.ended == Ended("bonds_broken", "2 of 4 bonds are broken")


def test_a_condition_on_the_stress_of_a_scene_without_plates_is_refused_where_it_stands(tmp_path):
    with pytest.raises(ConfigError, match=r"stop.0: force_drop looks at strain or stress, and the scene has no compr"):
        load(write(tmp_path, COLLISION), ["stop=[{type: force_drop}]"])
