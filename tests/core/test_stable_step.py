"""The limit is true: just below it scenes stay quiet, just above it they blow up. And the step follows it."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from clast import Simulation
from clast.config.scene import SceneConfig, from_mapping
from clast.engine.kernels.layout import V, X
from clast.errors import ConfigError, RunError
from tests.core.test_resume import assert_same_bytes
from tests.support.integrators import INTEGRATORS

GLASS = {"density": 2500, "young_modulus": 1e8, "poisson_ratio": 0.25}
NO_OUTPUT = {"samples": 20, "frames": 0, "writers": []}


def network(integrator: str, **time: Any) -> SceneConfig:
    """Return a bonded cluster of 27 spheres in space whose bonds never break."""
    bonds = {
        "type": "elastic",
        "young_modulus": 1e8,
        "poisson_ratio": 0.25,
        "normal_strength": 1e12,
        "shear_strength": 1e12,
    }
    random = np.random.default_rng(5)
    grid = np.stack(np.meshgrid(*[np.arange(3.0)] * 3), axis=-1).reshape(-1, 3)
    places = 2.1e-3 * grid + 1e-4 * random.uniform(-1.0, 1.0, grid.shape)
    speeds = 1e-6 * random.normal(size=grid.shape)
    particles = [
        {"position": x, "radius": 1e-3, "velocity": v} for x, v in zip(places.tolist(), speeds.tolist(), strict=True)
    ]
    return from_mapping(
        {
            "materials": {"glass": GLASS},
            "particles": {"type": "explicit", "material": "glass", "particles": particles},
            "bonds": {"between": {"max_gap": 1e-3}, "model": bonds},
            "integrator": integrator,
            "time": {"end": {"steps": 3000}, **time},
            "output": NO_OUTPUT,
        }
    )


def squeezed(restitution: float = 0.5, **time: Any) -> SceneConfig:
    """Return two spheres between two plates, one of which presses them together."""
    sphere = {"radius": 1e-3, "velocity": [0, 0, 0]}
    plate = {"type": "plane", "material": "glass"}
    return from_mapping(
        {
            "name": "squeezed",
            "materials": {"glass": GLASS},
            "particles": {
                "type": "explicit",
                "material": "glass",
                "particles": [sphere | {"position": [0, 0, z]} for z in (1e-3, 2.999e-3)],
            },
            "contacts": {"law": "hertz_mindlin", "pairs": {"default": {"restitution": restitution}}},
            "walls": {
                "lower": plate | {"point": [0, 0, 0], "normal": [0, 0, 1]},
                "upper": plate
                | {
                    "point": [0, 0, 3.998e-3],
                    "normal": [0, 0, -1],
                    "motion": {"type": "constant_velocity", "velocity": [0, 0, -2e-4]},
                },
            },
            "compression": {"upper": "upper", "lower": "lower", "height": 4e-3, "diameter": 2e-3},
            "time": {"end": {"strain": 0.1}, **time},
            "output": NO_OUTPUT,
        }
    )


FOLLOWING = {"rule": "spectral", "impact_speed": 1e-7}  # so slow that stability alone rules


def speed(simulation: Simulation) -> float:
    """Return the root mean square velocity in m/s."""
    v = simulation.world.particles.twist[:, V : V + 3]
    return float(np.sqrt(np.mean(v * v)))


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_free_network_is_quiet_below_the_limit_and_blows_up_above(integrator: str) -> None:
    limit = Simulation(network(integrator)).limits.spectral
    quiet = Simulation(network(integrator, step=0.95 * limit))
    before = speed(quiet)
    quiet.advance_to(3000)
    assert speed(quiet) < 3.0 * before  # near the limit, position and velocity share the energy unevenly
    loud = Simulation(network(integrator, step=1.05 * limit, allow_unstable=True))
    with pytest.raises(RunError, match=r"stopped at step \d+ .* particle \d+ (turns|moves) by"):
        loud.advance_to(400)
    assert speed(loud) > 100.0 * before


@pytest.mark.parametrize("restitution", [pytest.param(0.5, marks=pytest.mark.long), 0.0])
def test_pressed_contacts_come_to_rest_below_the_limit_and_never_above(restitution: float) -> None:
    reached = {}
    for share in (0.95, 1.05):
        simulation = Simulation(squeezed(restitution, step=2e-7))
        simulation.advance_to(simulation.last_step)
        simulation.world.walls.course[:] = 0.0  # the plate stops
        simulation.advance_to(simulation.step + 40_000)
        simulation.world.particles.twist[0, V + 2] = 1e-9
        simulation.change_step(share * simulation.stable_step())
        simulation._advance_to(simulation.step + 4000)
        reached[share] = speed(simulation)
    assert reached[0.95] < 1e-12
    assert reached[1.05] > 1e-6


def test_the_step_is_shortened_as_contacts_stiffen_and_never_above_the_limit() -> None:
    simulation = Simulation(squeezed(step=FOLLOWING))
    shares = []
    while simulation.step < simulation.last_step:
        simulation.advance_to(min(simulation.last_step, simulation.step + 500))
        shares.append(simulation.dt / simulation.stable_step())
    spans = simulation.timeline.spans
    assert len(spans) > 2
    assert all(later.dt < 0.95 * earlier.dt for earlier, later in pairwise(spans))
    assert max(shares) < 1.0
    assert simulation.time == pytest.approx(0.1 * 4e-3 / 2e-4, rel=1e-5)
    assert simulation.gauge.strain(simulation.world.walls) == pytest.approx(0.1, rel=1e-5)


def test_a_fixed_step_that_contacts_outgrow_stops_the_run_with_advice() -> None:
    step = 0.8 * Simulation(squeezed(step=FOLLOWING)).limits.spectral
    with pytest.raises(RunError, match=r"time\.step: the step of .* contacts have become stiffer.* rule 'spectral'"):
        Simulation(squeezed(step=step)).run()
    Simulation(squeezed(step=step, allow_unstable=True, end={"steps": 200})).run()


def test_samples_keep_their_distance_in_time_when_the_step_changes(tmp_path: Path) -> None:
    from clast import open_run, run_scene

    told = run_scene(squeezed(step=FOLLOWING), tmp_path / "run").summary
    assert told["time_step_changes"]
    assert told["time_step_ruled_by"] == "spectral"
    with open_run(tmp_path / "run") as run:
        time = run.curves["time_s"]
    interval = time[1] - time[0]
    assert len(time) == pytest.approx(21, abs=1)
    assert np.diff(time)[:-1] == pytest.approx(interval, abs=1.1 * told["time_step_s"])


def test_a_run_whose_step_changed_resumes_to_the_same_bytes(tmp_path: Path) -> None:
    from clast import run_scene
    from clast.session import Listener

    class Stop(Listener):
        def progress(self, simulation: Simulation, rate: float) -> None:
            if len(simulation.timeline.spans) > 2:
                raise KeyboardInterrupt

    scene = squeezed(step=FOLLOWING).changed({"output.checkpoint": "1 ms"})
    run_scene(scene, tmp_path / "whole")
    with pytest.raises((KeyboardInterrupt, RunError)):
        run_scene(scene, tmp_path / "stopped", listener=Stop())
    run_scene(scene, tmp_path / "stopped", resume=True)
    assert_same_bytes(tmp_path / "whole", tmp_path / "stopped")


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_change_of_the_step_costs_no_order(integrator: str) -> None:
    """Half a run with steps of one size, half with others: the error falls with the square of both."""
    period = 2.0 * np.pi / 2.0 * Simulation(network(integrator)).limits.network

    def end(steps: int, change: bool) -> np.ndarray:
        dt = 8.0 * period / steps
        simulation = Simulation(network(integrator, step=dt))
        simulation.advance_to(steps // 2)
        if change:
            simulation.change_step(0.5 * dt)
        simulation.advance_to(steps // 2 + (steps if change else steps // 2))
        return simulation.world.particles.pose[:, X : X + 3].copy()

    exact = end(25_600, change=False)
    errors = [float(np.abs(end(steps, change=True) - exact).max()) for steps in (200, 400)]
    assert np.log2(errors[0] / errors[1]) > 1.7


def test_a_rule_without_any_limit_says_so(tmp_path: Path) -> None:
    alone = {
        "materials": {"glass": GLASS},
        "particles": {"type": "explicit", "material": "glass", "particles": [{"position": [0, 0, 0], "radius": 1e-3}]},
        "time": {"end": {"time": 1.0}},
    }
    with pytest.raises(ConfigError, match=r"time\.step: no limit applies to this scene"):
        Simulation(from_mapping(alone))


def uneven(**changes: Any) -> SceneConfig:
    """Return a cluster in which one sphere is much smaller than the others, falling freely."""
    data = network("midstep").document.data
    spheres = [dict(each) for each in data["particles"]["particles"]]
    spheres[13]["radius"] = 0.4e-3
    time = {"end": {"steps": 2000}, **changes}
    gravity = [{"type": "gravity", "acceleration": [0, 0, -10.0]}]
    return from_mapping(
        dict(data) | {"particles": data["particles"] | {"particles": spheres}, "time": time, "body_forces": gravity}
    )


def test_only_particles_that_hold_the_step_back_are_made_heavier() -> None:
    plain = Simulation(uneven())
    target = 1.5 * plain.limits.spectral
    scaled = Simulation(uneven(selective_mass_scaling=target))
    heavier = scaled.scene.mass / plain.scene.mass
    assert scaled.limits.spectral >= target
    assert scaled.dt >= 0.8 * target
    assert heavier.argmax() == 13
    assert np.count_nonzero(heavier > 1.0) < 14
    assert heavier.min() == 1.0
    bounds = Simulation(uneven()).scene
    assert np.array_equal(bounds.mass, plain.scene.mass)


def test_heavier_particles_keep_their_weight_and_fall_as_one_with_the_rest(tmp_path: Path) -> None:
    from clast import run_scene

    scene = uneven(selective_mass_scaling=1.5 * Simulation(uneven()).limits.spectral)
    told = run_scene(scene.changed({"output.frames": 10}), tmp_path / "run").summary
    simulation = Simulation(scene)
    simulation.advance_to(2000)
    masses, true = simulation.scene.mass, simulation.scene.true_mass
    v = simulation.world.particles.twist[:, V + 2]
    weight = -10.0 * true.sum() * simulation.time
    assert masses @ v == pytest.approx(weight + masses @ simulation.scene.velocity[:, 2], rel=1e-9)
    assert told["particles_made_heavier"] >= 1
    assert told["added_mass_kg"] == pytest.approx(masses.sum() - true.sum())
    assert 0.0 < told["added_mass_share_of_kinetic_energy"] < 1.0
    assert told["added_mass_share"] == pytest.approx(masses.sum() / true.sum() - 1.0)


def test_check_build_tells_what_is_made_heavier() -> None:
    from clast.building import build_scene
    from clast.commands.build_report import mass_text

    target = 1.5 * Simulation(uneven()).limits.spectral
    assert "particles made heavier, by" in mass_text(build_scene(uneven(selective_mass_scaling=target)))
    assert "made heavier" not in mass_text(build_scene(uneven()))
