"""What a run does from end to end, and what it says when it cannot."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from clast import Simulation, load, open_run, run_scene
from clast.cli import main
from clast.errors import ConfigError, PluginError, RunError
from tests.scenes import COLLISION, CRUSH, write


@pytest.fixture
def collision(tmp_path: Path) -> Path:
    """Write the two spheres that meet head-on."""
    return write(tmp_path, COLLISION)


@pytest.fixture
def crush(tmp_path: Path) -> Path:
    """Write the small grain."""
    return write(tmp_path, CRUSH)


def test_two_spheres_part_with_the_restitution_asked_for(collision: Path, tmp_path: Path) -> None:
    run_scene(load(collision), tmp_path / "run")
    with open_run(tmp_path / "run") as run:
        v = run.tracks["particles"]["velocity"]
    approach, parting = v[0, 0, 0] - v[0, 1, 0], v[-1, 1, 0] - v[-1, 0, 0]
    assert parting / approach == pytest.approx(0.5, abs=1e-4)
    assert v[:, 0, 0] + v[:, 1, 0] == pytest.approx(0.0, abs=1e-15)


def test_without_damping_the_impact_keeps_energy_and_meets_hertz(collision: Path, tmp_path: Path) -> None:
    scene = load(collision).changed({"contacts.pairs.default.restitution": 1.0, "time.step": "2e-8 s"})
    run_scene(scene, tmp_path / "run")
    with open_run(tmp_path / "run") as run:
        track = run.tracks["particles"]
    E_star, R_star = 0.5 * 100e6 / (1 - 0.25**2), 0.5e-3
    m_star = 0.5 * 2500 * 4 / 3 * np.pi * 1e-9
    k = 4 / 3 * E_star * np.sqrt(R_star)
    overlap = (5 * m_star * 0.2**2 / (4 * k)) ** 0.4
    assert -track["force"][:, 0, 0].min() == pytest.approx(k * overlap**1.5, rel=1e-3)
    assert track["velocity"][-1, 1, 0] == pytest.approx(0.1, rel=1e-6)


def test_tracks_come_as_csv_with_one_row_a_sample(collision: Path, tmp_path: Path) -> None:
    outcome = run_scene(load(collision), tmp_path / "run")
    rows = (tmp_path / "run" / "tracks_particles.csv").read_text().splitlines()
    assert rows[0].startswith("time_s,particle_0_position_x,particle_0_position_y")
    assert len(rows) == 402
    assert outcome.written["tracks of particles"].path == tmp_path / "run" / "tracks_particles.csv"


def test_the_curves_come_in_the_promised_order(crush: Path, tmp_path: Path) -> None:
    run_scene(load(crush).changed({"time.end.strain": 0.02}), tmp_path / "run")
    header = (tmp_path / "run" / "curves.csv").read_text().splitlines()[0]
    kinds = (("force", "N"), ("moment", "Nm"))
    plates = [f"{kind}_{w}_{c}_{unit}" for w in ("upper", "lower") for kind, unit in kinds for c in "xyz"]
    strain = ["time_s", "displacement_m", "strain", "stress_Pa", "force_upper_N", "force_lower_N"]
    assert header.split(",") == [*strain, *plates, "bonds_intact", "bonds_broken"]


@pytest.mark.parametrize("force", ["instantaneous", "mean"])
def test_the_moment_on_a_wall_is_that_of_its_force_about_the_walls_point(
    collision: Path, tmp_path: Path, force: str
) -> None:
    floor = {"type": "plane", "material": "glass", "point": [0, 0, "-1.001 mm"], "normal": [0, 0, 1]}
    falling = {"position": ["2 mm", "3 mm", 0], "velocity": [0, 0, "-0.1 m/s"], "radius": "1 mm"}
    away = {"position": ["-20 mm", 0, "20 mm"], "radius": "1 mm"}
    scene = load(collision).changed(
        {"walls": {"floor": floor}, "particles.particles": [falling, away], "output.force": force}
    )
    run_scene(scene, tmp_path / "run")
    with open_run(tmp_path / "run") as run:
        push = run.curves["force_floor_z_N"]
        moment = [run.curves[f"moment_floor_{c}_Nm"] for c in "xyz"]
    assert push.min() < -0.01
    assert moment[0] == pytest.approx(3e-3 * push, rel=1e-12, abs=1e-15)
    assert moment[1] == pytest.approx(-2e-3 * push, rel=1e-12, abs=1e-15)
    assert (moment[2] == 0.0).all()


def test_a_resolved_config_runs_the_same_scene_again(crush: Path, tmp_path: Path) -> None:
    scene = load(crush).changed({"time.end.strain": 0.02})
    run_scene(scene, tmp_path / "run")
    again = load(tmp_path / "run" / "config.yaml")
    assert again.resolved() == scene.resolved()


def test_no_frames_are_kept_when_none_are_asked_for(collision: Path, tmp_path: Path) -> None:
    scene = load(collision).changed({"output.frames": 0, "output.writers": ["recording"]})
    outcome = run_scene(scene, tmp_path / "run")
    assert "no frames" in outcome.written["recording"].skipped


def test_a_step_above_the_limit_is_refused(crush: Path) -> None:
    with pytest.raises(ConfigError, match="above the stability limit"):
        Simulation(load(crush).changed({"time.step": "2e-6 s"}))


def test_a_run_that_blows_up_stops_with_its_last_checkpoint(crush: Path, tmp_path: Path) -> None:
    scene = load(crush).changed({"time.step": "2e-6 s", "time.allow_unstable": True})
    with pytest.raises(RunError, match=r"stopped at step .* smaller time\.step"):
        run_scene(scene, tmp_path / "run")
    assert (tmp_path / "run" / "checkpoint.h5").exists()


def test_particles_that_leave_the_domain_are_removed_and_counted(collision: Path, tmp_path: Path) -> None:
    domain = {"lower": ["-1.003 mm", -1, -1], "upper": [1, 1, 1]}
    scene = load(collision).changed(
        {"boundaries": {"domain": domain}, "neighbours.skin": "1 um", "time.end.time": "2e-3 s"}
    )
    outcome = run_scene(scene, tmp_path / "run")
    assert outcome.summary["particles_removed"] == 1
    assert outcome.summary["fragments"] == 1
    with open_run(tmp_path / "run") as run:
        assert np.isnan(run.frame(-1).position[0]).all()
        assert run.curves["particles_removed"][[0, -1]].tolist() == [0.0, 1.0]


def test_overlaps_at_the_start_are_refused(collision: Path) -> None:
    scene = load(collision).changed({"particles.particles.1.position": ["0.5 mm", 0, 0]})
    with pytest.raises(ConfigError, match=r"particles\.particles\.1: particle 1 overlaps particle 0 by"):
        Simulation(scene)


def test_a_law_that_raises_is_told_with_its_own_line(tmp_path: Path) -> None:
    law = Path("docs/examples/my_law.py").read_text()
    broken = law.replace("    return state.largest / c.eps_f", "    raise ValueError('boo')")
    assert broken != law
    write(tmp_path, broken, "my_law.py")
    scene = write(tmp_path, Path("docs/examples/my_law.yaml").read_text())
    with pytest.raises(PluginError, match=r"my_law\.py:\d+: failure raised ValueError: boo"):
        Simulation(load(scene))


def test_check_build_tells_limits_and_what_is_left_out(crush: Path) -> None:
    told = CliRunner().invoke(main, ["check", "--build", str(crush)])
    assert told.exit_code == 0
    for words in ("bond network 2/omega_max", "overlaps", "touching neighbours", "Left out", "body forces"):
        assert words in told.output


@pytest.mark.parametrize("asked", [True, False])
def test_check_build_tells_whether_the_energy_ledger_is_compiled_in(crush: Path, asked: bool) -> None:
    told = CliRunner().invoke(main, ["check", "--build", str(crush), "--set", f"output.ledger={asked}"])
    compiled_in, left_out = told.output.split("Left out")
    assert ("energy ledger" in compiled_in, "energy ledger" in left_out) == (asked, not asked)


@pytest.mark.long
def test_velocity_verlet_leapfrog_and_midstep_agree_on_an_elastic_press(crush: Path) -> None:
    elastic = {"bonds.model.yield_stress": "1 GPa", "bonds.model.breakage_strain": 0.5, "time.end.strain": 0.06}
    forces = []
    for integrator in ("midstep", "leapfrog", "velocity_verlet"):
        simulation = Simulation(load(crush).changed({"integrator": integrator, **elastic}))
        simulation.advance_to(simulation.last_step)
        forces.append(simulation.gauge.forces(simulation.world.walls.force)[0])
    assert forces[0] > 0.0
    assert forces[1:] == pytest.approx([forces[0]] * 2, rel=0.02)
