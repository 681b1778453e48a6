"""A run that a condition ends: what it leaves behind, and that it stays ended."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from clast import Simulation, load, open_run, run_scene
from clast.ended import Ended
from clast.errors import ConfigError
from clast.results import checkpoint
from clast.results.in_words import summary_rows
from clast.results.stops import Stops
from clast.scene.compression import Gauge
from clast.verification.asking import Asking
from clast.verification.bench import scene_file
from tests.scenes import COLLISION, CRUSH, write

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


STAGED = """walls.upper.motion=[
  {type: constant_velocity, velocity: [0, 0, -20 mm/s], until: {type: force, wall: upper, above: 0.5 N}},
  {type: constant_velocity, velocity: [0, 0, 10 mm/s], until: {type: elapsed, time: 0.2 ms}},
  {type: constant_velocity, velocity: [0, 0, 20 mm/s], until: {type: force, wall: upper, below: 0.1 N}}]"""
ENDED = ["stop=[{type: stages_over, wall: upper}]", "time.end={time: 5 ms}", "output.writers=[]", "output.samples=400"]


def test_a_wall_goes_through_its_stages_and_then_the_run_ends(tmp_path):
    scene = load(write(tmp_path, CRUSH), [STAGED, *ENDED])
    assert run_scene(scene, tmp_path / "run").summary["ended_by"]["by"] == "stages_over"
    with open_run(tmp_path / "run") as run:
        stage, force, time = (run.curves[name] for name in ("stage_upper", "force_upper_z_N", "time_s"))
    assert np.unique(stage[:-1]).tolist() == [1.0, 2.0, 3.0]
    assert stage[-1] == 0.0
    first, second, third = np.nonzero(np.diff(stage))[0]  # the last sample of each stage
    assert force[first] >= 0.5 > force[:first].max()
    assert 0.2e-3 <= time[second] - time[first] < 0.2e-3 + time[1]
    assert force[third] <= 0.1 < force[first:third].min()


def test_a_stage_that_never_ended_is_told(tmp_path):
    short = [*ENDED[2:], "time.end={time: 0.1 ms}"]
    told = run_scene(load(write(tmp_path, CRUSH), [STAGED, *short]), tmp_path / "run").summary["warnings"]
    assert any("walls.upper was still in motion 1 of 3 (constant_velocity) at the end" in text for text in told)


def test_a_wall_turns_at_the_same_sample_after_a_resume(tmp_path):
    scene = load(write(tmp_path, CRUSH), [STAGED, *ENDED])
    whole, half, resumed = (Simulation(scene, threads=1) for _ in range(3))
    asked = [Asking(simulation, 20, force_on_the_plate) for simulation in (whole, half, resumed)]
    whole.run([asked[0]])
    over = int(np.nonzero([row["stage"] == 2.0 for row in asked[0].rows])[0][0])
    half.last_step = 20 * over - 30  # in the second stage
    half.run([asked[1]])
    assert half.world.walls.stage[0, 0] == 1
    checkpoint.save(tmp_path, half, {})
    checkpoint.load(tmp_path, resumed)
    asked[2].stops.recall({name: np.array([row[name] for row in asked[1].rows]) for name in asked[1].rows[0]})
    resumed.run([asked[2]])
    assert resumed.world.walls.stage[0, 0] == 3
    assert asked[1].rows + asked[2].rows == asked[0].rows
    for (name, one), (_, other) in zip(checkpoint.state_arrays(whole), checkpoint.state_arrays(resumed), strict=True):
        assert one.tobytes() == other.tobytes(), name


def force_on_the_plate(simulation):
    walls = simulation.world.walls
    force = {f"force_upper_{c}_N": float(walls.force[0, k]) for k, c in enumerate("xyz")}
    stage = float(walls.stage[0, 0])
    return {"time_s": simulation.time, **force, "stage": stage, "stage_upper": 0.0 if stage == 3.0 else stage + 1.0}


@pytest.mark.parametrize(
    ("motion", "told"),
    [
        ("[{type: constant_velocity, velocity: [0, 0, 1]}, {type: constant_velocity, velocity: [0, 0, 2]}]",
         r"walls.upper.motion.0: motion 0 \(constant_velocity\) is never over"),
        ("[]", r"walls.upper.motion: must have 1 or more entries"),
        ("[{type: constant_velocity, velocity: [0, 0, 1], untill: force}]",
         r"walls.upper.motion.0.untill: not a known key; did you mean 'until'"),
        ("[{type: constant_velocity, velocity: [0, 0, 1], until: {type: force, wall: uper, above: 1 N}}]",
         r"walls.upper.motion.0.until.wall: there is no wall 'uper'; did you mean 'upper'"),
        ("{type: constant_velocity, velocity: [0, 0, 1], until: {type: strain, strain: 0.1}}",
         r"walls.upper.motion.until: strain looks at strain or stress, and the scene has no compression"),
        ("[{type: constant_velocity, velocity: [0, 0, 1], until: {type: stages_over, wall: upper}}]",
         r"walls.upper.motion.0.until: stages_over waits for the end of the stages that it ends one of"),
        ("{type: constant_velocity, velocity: [0, 0, 1], until: {type: force, wall: upper, above: -1 N}}",
         r"walls.upper.motion.until.above: the length of a force is never -1 N; give a direction for its sign"),
        ("{type: constant_velocity, velocity: [0, 0, 1], until: {type: force, wall: upper}}",
         r"walls.upper.motion.until: exactly one of above and below is needed; given neither"),
    ],
)  # fmt: skip
def test_stages_that_cannot_be_are_refused_where_they_stand(tmp_path, motion, told):
    with pytest.raises(ConfigError, match=told):
        load(write(tmp_path, CRUSH), ["compression=null", "time.end={time: 1 ms}", f"walls.upper.motion={motion}"])


def test_a_strain_at_the_end_of_stages_is_refused_as_nobody_knows_when(tmp_path):
    staged = "{type: constant_velocity, velocity: [0, 0, -1], until: {type: strain, strain: 0.1}}"
    scene = load(write(tmp_path, CRUSH), [f"walls.upper.motion={staged}"])
    with pytest.raises(ConfigError, match=r"time.end.strain: walls.upper moves until a condition holds"):
        Gauge(scene).last_step(1e-6)


def test_a_wall_that_has_no_stages_has_none_to_be_over(tmp_path):
    with pytest.raises(ConfigError, match=r"stop.0.wall: the motion of walls.upper has no stage that ends"):
        load(write(tmp_path, CRUSH), ["stop=[{type: stages_over, wall: upper}]"])


def test_stages_whose_last_one_never_ends_are_not_waited_for(tmp_path):
    still = "{type: constant_velocity, velocity: [0, 0, 0]}"
    staged = f"[{{type: constant_velocity, velocity: [0, 0, -1], until: {{type: elapsed, time: 1 ms}}}}, {still}]"
    file = write(tmp_path, CRUSH)
    changes = ["time.end={time: 1 ms}", f"walls.upper.motion={staged}"]
    told = r"the last motion of walls.upper, number 1 \(constant_velocity\), is never over; give walls.upper.motion.1 a"
    with pytest.raises(ConfigError, match=rf"stop.0.wall: stages_over can never hold: {told} condition 'until'"):
        load(file, [*changes, "stop=[{type: stages_over, wall: upper}]"])
    awaiting = "{type: constant_velocity, velocity: [0, 0, 0], until: {type: stages_over, wall: upper}}"
    with pytest.raises(ConfigError, match=r"walls.lower.motion.until.wall: stages_over can never hold"):
        load(file, [*changes, f"walls.lower.motion={awaiting}"])
