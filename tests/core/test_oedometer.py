"""Plates in a tube: what presses on the tube, how much of the load it carries, and what a run tells of it."""

from __future__ import annotations

import json
import re
from math import asin, cos, pi, sin, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from clast import Simulation, load, open_run, run_scene
from clast.cli import main
from clast.config.scene import from_mapping
from clast.config.yaml_loader import dump_yaml
from clast.errors import ConfigError
from clast.forecast import forecast
from clast.results.in_words import summary_rows
from clast.results.side import side_results, side_rows
from clast.results.warnings import compression_warnings
from clast.scene.compression import Gauge
from clast.scene.narrow_plates import narrow_plates

GLASS = {"density": 2500, "young_modulus": "1 GPa", "poisson_ratio": 0.25}
R = 1.4e-3
"""Inner radius of the tube."""


def oedometer(particles: list[dict[str, Any]], top: float, contact: dict[str, float], motion: Any) -> dict[str, Any]:
    """Return a scene: particles in a tube between a bottom at height 0 and a piston."""
    wall = {"material": "glass", "type": "plane"}
    return {
        "materials": {"glass": GLASS},
        "particles": {"type": "explicit", "material": "glass", "particles": particles},
        "contacts": {"law": "hertz_mindlin", "pairs": {"default": contact}},
        "walls": {
            "bottom": wall | {"point": [0, 0, 0], "normal": [0, 0, 1]},
            "tube": {"type": "cylinder", "material": "glass", "point": [0, 0, 0], "axis": [0, 0, 1], "radius": R},
            "piston": wall | {"point": [0, 0, top], "normal": [0, 0, -1], "motion": motion},
        },
        "compression": {"upper": "piston", "lower": "bottom", "side": "tube", "height": top, "diameter": 2 * R},
        "time": {"end": {"time": "28 ms"}},
        "output": {"writers": [], "samples": 100, "frames": 2},
    }


def two_spheres(force: float) -> tuple[dict[str, Any], float, float]:
    """Return two spheres that wedge each other against the tube, their slope from the vertical, and their height."""
    r = 1e-3
    slope = asin((R - r) / r)
    height = 2.0 * r + 2.0 * r * cos(slope)
    spheres = [
        {"position": [-(R - r), 0, r], "radius": r},
        {"position": [R - r, 0, height - r], "radius": r},
    ]
    motion = {"type": "force_control", "direction": [0, 0, -1], "force": force, "max_velocity": "2 mm/s"}
    return oedometer(spheres, height, {"restitution": 0.3}, motion), slope, height


def bed() -> dict[str, Any]:
    """Return loose layers of seven spheres, each layer turned against the one below, with friction everywhere."""
    r, layers, spacing = 0.4e-3, 7, 0.82e-3
    spheres = []
    for layer in range(layers):
        z = r + layer * spacing
        aside = 0.1e-3 * (-1) ** layer
        spheres.append({"position": [aside, aside, z], "radius": r})
        for k in range(6):
            angle = (k + 0.4 * layer) * pi / 3.0
            spheres.append({"position": [(R - r) * cos(angle), (R - r) * sin(angle), z], "radius": r})
    top = 2.0 * r + (layers - 1) * spacing
    motion = {"type": "velocity_ramp", "end": [0, 0, "-50 mm/s"], "duration": "2 ms"}
    return oedometer(spheres, top, {"restitution": 0.3, "sliding_friction": 0.4}, motion)


def test_two_smooth_spheres_press_on_the_tube_as_their_slope_tells() -> None:
    """Where forces from opposite sides cancel in the force on the tube, their sum along the normals does not."""
    force = 1e-3
    scene, slope, height = two_spheres(force)
    simulation = Simulation(from_mapping(scene))
    simulation.advance_to(simulation.last_step)
    walls = simulation.world.walls
    side = simulation.gauge.side_reading(walls, walls.force, walls.pressing)
    assert side is not None
    assert walls.pressing[1] == pytest.approx(2.0 * force * tan(slope), rel=2e-3)
    assert np.abs(walls.force[1]).max() < 1e-6 * force
    assert side.stress_side_Pa == pytest.approx(walls.pressing[1] / (2.0 * pi * R * height), rel=1e-3)
    assert side.stress_lower_Pa == pytest.approx(force / (pi * R**2), rel=1e-4)
    assert side.lateral_pressure_coefficient == pytest.approx(R * tan(slope) / height, rel=2e-3)
    assert side.wall_friction_share == pytest.approx(0.0, abs=1e-9)


def test_four_planes_around_carry_what_a_tube_of_their_girth_does() -> None:
    force = 1e-3
    scene, slope, height = two_spheres(force)
    del scene["walls"]["tube"]
    planes = {"left": (-R, 0, 1), "right": (R, 0, -1), "front": (-R, 1, 1), "back": (R, 1, -1)}
    for name, (place, axis, way) in planes.items():
        point, normal = [0.0, 0.0, 0.0], [0, 0, 0]
        point[axis], normal[axis] = place, way
        scene["walls"][name] = {"type": "plane", "material": "glass", "point": point, "normal": normal}
    scene["compression"] |= {"side": list(planes), "area": 4.0 * R * R}
    del scene["compression"]["diameter"]
    simulation = Simulation(from_mapping(scene))
    simulation.advance_to(simulation.last_step)
    walls = simulation.world.walls
    side = simulation.gauge.side_reading(walls, walls.force, walls.pressing)
    assert side is not None
    assert side.stress_side_Pa == pytest.approx(2.0 * force * tan(slope) / (8.0 * R * height), rel=2e-3)
    assert side.stress_lower_Pa == pytest.approx(force / (4.0 * R * R), rel=1e-4)
    assert side.wall_friction_share == pytest.approx(0.0, abs=1e-9)


def test_the_mean_of_what_presses_is_that_of_all_steps_since_the_sample_before() -> None:
    simulation = Simulation(from_mapping(two_spheres(1e-3)[0]))
    simulation.advance_to(1000)
    simulation.world.walls.pressing_sum[:] = 0.0
    told = []
    for _ in range(20):
        simulation.advance_to(simulation.step + 1)
        told.append(simulation.world.walls.pressing.copy())
    assert np.ptp(np.array(told)[:, 1]) > 0.0
    assert simulation.world.walls.pressing_sum == pytest.approx(np.sum(told, axis=0), rel=1e-12)


@pytest.fixture(scope="module")
def pressed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Press the bed; return the folder of the run."""
    folder = tmp_path_factory.mktemp("bed")
    file = folder / "bed.yaml"
    file.write_text(dump_yaml(bed()))
    run_scene(load(file), folder / "run")
    return folder / "run"


def test_the_piston_is_carried_by_the_bottom_and_the_friction_of_the_tube(pressed: Path) -> None:
    with open_run(pressed) as run:
        curves = run.curves
    loaded = curves["force_upper_N"] > 0.2 * curves["force_upper_N"].max()
    carried = -curves["force_tube_z_N"]
    assert np.count_nonzero(loaded) > 5
    assert (carried + curves["force_lower_N"])[loaded] == pytest.approx(curves["force_upper_N"][loaded], rel=0.01)
    assert (curves["wall_friction_share"][loaded] > 0.05).all()
    assert curves["wall_friction_share"][loaded] * curves["force_upper_N"][loaded] == pytest.approx(carried[loaded])


def test_the_stress_on_the_tube_is_what_presses_over_its_face_between_the_plates(pressed: Path) -> None:
    with open_run(pressed) as run:
        curves, height = run.curves, run.config["walls"]["piston"]["point"][2]
    face = 2.0 * pi * R * (height - curves["displacement_m"])
    assert curves["stress_side_Pa"] == pytest.approx(curves["normal_force_tube_N"] / face, rel=1e-9)
    sideways = np.hypot(curves["force_tube_x_N"], curves["force_tube_y_N"])
    assert sideways[-1] < 0.1 * curves["normal_force_tube_N"][-1]
    assert [name for name in curves if name.startswith("normal_force")] == ["normal_force_tube_N"]
    axial = 0.5 * (curves["stress_Pa"] + curves["stress_lower_Pa"])
    unloaded = axial <= 0.0
    assert unloaded.any()
    assert (curves["lateral_pressure_coefficient"][unloaded] == 0.0).all()
    ratio = curves["stress_side_Pa"][~unloaded] / axial[~unloaded]
    assert curves["lateral_pressure_coefficient"][~unloaded] == pytest.approx(ratio)


def test_the_summary_tells_peak_end_and_loading_in_numbers_and_words(pressed: Path) -> None:
    summary = json.loads((pressed / "summary.json").read_text())
    told, rows = summary["side_wall"], dict(summary_rows(summary))
    assert told["at_peak"]["stress_upper_Pa"] == summary["peak_stress_Pa"]
    assert 0.05 < told["over_the_loading"]["lateral_pressure_coefficient"] < 1.0
    assert f"{told['over_the_loading']['lateral_pressure_coefficient']:.3f} over" in rows["side over mean axial stress"]
    assert 0.0 < told["over_the_loading"]["unbalanced_share"] < 0.05
    assert rows["upper - lower - side wall"].startswith(f"mean {told['over_the_loading']['unbalanced_share']:.1%} of")
    assert summary["warnings"] == []
    assert f"{told['at_the_end']['wall_friction_share']:.1%} at the end" in rows["carried by wall friction"]
    assert f"{told['at_peak']['stress_side_Pa'] / 1e6:.3f} MPa at the peak" in rows["stress on the side wall"]


def test_the_loading_counts_from_a_fifth_of_the_peak_to_the_peak_by_its_load() -> None:
    curves = {
        "stress_Pa": np.array([1.0, 4.0, 10.0, 2.0]),
        "stress_lower_Pa": np.array([1.0, 2.0, 8.0, 2.0]),
        "stress_side_Pa": np.array([9.0, 1.5, 4.5, 9.0]),
        "lateral_pressure_coefficient": np.array([9.0, 0.5, 0.5, 4.5]),
        "wall_friction_share": np.array([0.0, 0.5, 0.2, 0.0]),
    }
    loading = side_results(curves)["side_wall"]["over_the_loading"]
    assert loading["lateral_pressure_coefficient"] == pytest.approx(6.0 / 12.0)
    assert loading["wall_friction_share"] == pytest.approx((2.0 + 2.0) / 14.0)
    assert loading["unbalanced_share"] == pytest.approx((4.0 - 2.0 - 2.0 + 10.0 - 8.0 - 2.0) / 14.0)
    curves["stress_lower_Pa"][1:3] = 3.0, 6.0
    loading = side_results(curves)["side_wall"]["over_the_loading"]
    assert loading["unbalanced_share"] == pytest.approx((1.0 + 2.0) / 14.0)
    nothing = side_results({name: np.zeros(3) for name in curves})["side_wall"]
    assert nothing["over_the_loading"]["lateral_pressure_coefficient"] is None
    assert side_rows(nothing) == [("side wall", "nothing pressed on the plates")]
    assert side_results({"stress_Pa": np.ones(2)}) == {}


def test_forces_that_do_not_balance_are_pointed_out_from_five_percent_on() -> None:
    pressed = from_mapping(bed()).compression
    assert pressed is not None
    told = {"peak_stress_Pa": 1.0, "side_wall": {"over_the_loading": {"unbalanced_share": 0.051}}}
    (warning,) = compression_warnings(pressed, told)
    assert warning.startswith("walls.bottom and walls.tube carry 5.1% more or less than walls.piston presses with")
    assert "Lower the velocity of the walls or time.mass_scaling" in warning
    told["side_wall"] = {"over_the_loading": {"unbalanced_share": 0.049}}
    assert compression_warnings(pressed, told) == []


def test_a_piston_that_meets_nothing_is_told_in_place_of_a_stress_of_zero(tmp_path: Path) -> None:
    scene = bed()
    scene["walls"]["piston"]["point"], scene["compression"]["height"] = [0, 0, 7e-3], 7e-3
    scene["time"]["end"] = {"strain": 0.025}
    scene["output"] = {"writers": [], "samples": 20, "frames": 0}
    summary = run_scene(from_mapping(scene), tmp_path / "run").summary
    rows = dict(summary_rows(summary))
    assert rows["peak stress"] == "none: the upper wall met nothing"
    assert not [name for name in rows if "modulus" in name]
    (warning,) = summary["warnings"]
    assert rows["WARNING"] == warning
    assert warning.startswith("walls.piston met nothing in the whole run, so there is no stress; let it begin nearer")
    result = CliRunner().invoke(main, ["report", str(tmp_path / "run")])
    assert result.exit_code == 0, result.output
    page = (tmp_path / "run" / "report.html").read_text(encoding="utf-8")
    assert page.index("Before you read on") < page.index("walls.piston met nothing") < page.index("Summary</h2>")
    assert "need not be the peak" not in page
    assert "0.00 MPa" not in page


def test_nothing_is_caught_or_slips_past_at_the_rim_of_a_disc_as_wide_as_the_tube() -> None:
    scene = bed()
    scene["walls"]["piston"] |= {"type": "disc", "radius": R}
    simulation = Simulation(from_mapping(scene))
    simulation.advance_to(40_000)
    world = simulation.world
    place, radius = world.particles.pose[:, :3], simulation.scene.radius
    piston = scene["walls"]["piston"]["point"][2] + world.walls.displacement[2, 2]
    assert world.walls.force[2, 2] > 0.1
    assert (place[:, 2] + 0.95 * radius < piston).all()
    assert (np.hypot(place[:, 0], place[:, 1]) + 0.95 * radius < R).all()


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"compression.height": 7e-3}, r"compression.height: 7 mm, but walls.piston stands 5.72 mm from walls.bottom"),
        ({"compression.height": 5.65e-3}, r"compression.height: 5.65 mm, but walls.piston stands 5.72 mm"),
        ({"walls.piston.point": [1e-3, 0, 8e-3]}, r"compression.height: 5.72 mm, but walls.piston stands 8 mm"),
        (
            {"compression.diameter": 20e-3},
            r"compression.diameter: 20 mm, but walls.tube has the section of a circle of 2.8 mm",
        ),
        (
            {"walls.tube.radius": 1.43e-3},
            r"compression.diameter: 2.8 mm, but walls.tube has the section of a circle of 2.86 mm",
        ),
    ],
)
def test_strain_and_stress_that_are_not_those_of_the_walls_are_refused(changes: dict[str, Any], said: str) -> None:
    config = from_mapping(bed()).changed(changes)
    with pytest.raises(ConfigError, match=said):
        Gauge(config)
    with pytest.raises(ConfigError, match=said):
        forecast(config)


def test_a_plate_aside_of_the_middle_is_as_far_away_and_one_percent_is_let_pass() -> None:
    changes = {"walls.piston.point": [1e-3, 0, 5.72e-3], "compression.height": 5.75e-3, "compression.diameter": 2.82e-3}
    assert Gauge(from_mapping(bed()).changed(changes)).height == 5.75e-3


@pytest.mark.parametrize("given", [{"area": 1e-6, "diameter": 1e-3}, {}])
def test_a_section_is_given_once(given: dict[str, float]) -> None:
    scene = bed()
    del scene["compression"]["diameter"]
    scene["compression"] |= given
    with pytest.raises(ConfigError, match="compression: give exactly one of 'diameter' and 'area'"):
        from_mapping(scene)


@pytest.mark.parametrize(
    ("radius", "said"),
    [
        (
            0.7 * R,
            r"walls.piston leaves room for balls of 0.42\d? mm to walls.tube: particles of 0.2 mm slip past it; make",
        ),
        (0.9 * R, None),
        (None, None),
    ],
)
def test_a_plate_that_particles_slip_past_is_pointed_out(radius: float | None, said: str | None) -> None:
    scene = bed()
    scene["walls"]["piston"] |= {} if radius is None else {"type": "disc", "radius": radius}
    told = narrow_plates(from_mapping(scene), 0.2e-3)
    assert [re.match(said or "", each) is not None for each in told] == [True] * (said is not None)


@pytest.mark.parametrize(
    ("side", "said"),
    [
        ("tub", "compression.side: there is no wall 'tub'; did you mean 'tube'?"),
        ("piston", "compression.side: the side must be another wall than upper and lower"),
        ("lid", "compression.side: walls.lid is a plane, of which girth and section are not known; name a wall such"),
        (["tube", "lid"], "compression.side: walls.tube is a cylinder, and only infinite planes surround"),
        (["lid", "tub"], "compression.side: there is no wall 'tub'; did you mean 'tube'?"),
        (["lid", "lid"], "compression.side: 'lid' is named twice; name every wall around once"),
    ],
)
def test_a_side_that_cannot_be_is_refused(side: str | list[str], said: str) -> None:
    scene = bed()
    scene["compression"]["side"] = side
    scene["walls"]["lid"] = {"type": "plane", "material": "glass", "point": [0, 0, 1], "normal": [0, 0, -1]}
    with pytest.raises(ConfigError) as told:
        Simulation(from_mapping(scene))
    assert said in str(told.value)
