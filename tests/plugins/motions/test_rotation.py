"""Walls that turn: lists that never miss a contact, a closed ledger, resumes, stages, repeats and pictures."""

from __future__ import annotations

from math import cos, pi, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from clast.building import build_scene
from clast.config.scene import SceneConfig, from_mapping
from clast.engine.kernels.layout import ANGLE, ARM
from clast.engine.wall_frames import WallFrames, surface_velocities
from clast.errors import ConfigError
from clast.results import checkpoint
from clast.results.run import open_run
from clast.results.wall_mesh import WallMesh
from clast.scene.compression import Gauge
from clast.scene.repeats import check_repeats
from clast.session import run_scene
from clast.simulation import Simulation

PADDLE = [
    [[-7e-3, -3e-3, 0.0], [7e-3, -3e-3, 0.0], [7e-3, 3e-3, 0.0]],
    [[-7e-3, -3e-3, 0.0], [7e-3, 3e-3, 0.0], [-7e-3, 3e-3, 0.0]],
]
TURNING = {"type": "rotation", "axis": [0, 1, 0], "rate": 60.0, "speed_up": 5e-3}
GLASS = {"density": 2500, "young_modulus": 5e6, "poisson_ratio": 0.2}
DRUM = {"type": "cylinder", "material": "glass", "point": [0, 0, 0], "axis": [0, 1, 0], "radius": 10e-3}


def mixer(**more: Any) -> SceneConfig:
    """Return eight spheres in a drum that rests, and a paddle that turns among them."""
    places = [[x, y, z] for x in (-3e-3, 3e-3) for y in (-1.5e-3, 1.5e-3) for z in (-5e-3, 3e-3)]
    ends = {
        name: {"type": "plane", "material": "glass", "point": [0, s * 3e-3, 0], "normal": [0, -s, 0]}
        for name, s in (("front", -1), ("back", 1))
    }
    pair = {"restitution": 0.6, "sliding_friction": 0.4, "rolling_friction": 0.05}
    return from_mapping(
        {
            "materials": {"glass": GLASS},
            "particles": {
                "type": "explicit",
                "material": "glass",
                "particles": [{"position": x, "radius": 1.2e-3} for x in places],
            },
            "contacts": {"law": "hertz_mindlin", "pairs": {"default": pair}},
            "walls": {
                "drum": DRUM,
                **ends,
                "paddle": {"type": "mesh", "material": "glass", "triangles": PADDLE, "motion": TURNING},
            },
            "time": {"step": 5e-6, "end": {"time": 60e-3}},
            "output": {"ledger": True, "frames": 3, "samples": 4, "writers": []},
        }
        | more
    )


@pytest.fixture(scope="module")
def mixed() -> Simulation:
    simulation = Simulation(mixer())
    simulation.advance_to(simulation.last_step)
    return simulation


def test_the_work_of_the_paddle_is_in_the_ledger(mixed: Simulation) -> None:
    books = mixed.ledger()
    assert books.walls > 1e-6
    assert abs(books.closure) < 5e-4


def test_no_contact_is_missed_however_seldom_neighbours_are_searched(mixed: Simulation) -> None:
    often = Simulation(mixer(neighbours={"skin": 0.05e-3}))
    often.advance_to(often.last_step)
    assert often.lists.made > 3 * mixed.lists.made
    np.testing.assert_array_equal(often.world.particles.pose, mixed.world.particles.pose)


def test_a_resumed_run_goes_on_with_the_same_bits(mixed: Simulation, tmp_path: Path) -> None:
    stopped, resumed = Simulation(mixer()), Simulation(mixer())
    stopped.advance_to(5000)
    checkpoint.save(tmp_path, stopped, {})
    checkpoint.load(tmp_path, resumed)
    resumed.advance_to(resumed.last_step)
    np.testing.assert_array_equal(resumed.world.particles.pose, mixed.world.particles.pose)
    np.testing.assert_array_equal(resumed.world.walls.pose, mixed.world.walls.pose)


def test_the_angle_is_that_of_the_rate(mixed: Simulation) -> None:
    w, _, y, _ = mixed.world.walls.pose[3, 3:].tolist()
    angle = 60.0 * (60e-3 - 0.5 * 5e-3)
    assert (w, y) == pytest.approx(
        (cos(0.5 * angle), sin(0.5 * angle)), abs=1e-7
    )  # the rate of the first half step is 0
    assert mixed.world.walls.pose[0].tolist() == [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]


def test_a_surface_moves_as_the_difference_of_its_places(mixed: Simulation) -> None:
    walls, span = mixed.world.walls, 1e-6
    place = np.array([[4e-3, 1e-3, 2e-3]])
    frame = WallFrames(walls.pose, walls.centre)
    later = walls.pose.copy()
    half = 0.5 * 60.0 * span
    w, _, y, _ = later[3, 3:]
    later[3, 3:] = [cos(half) * w - sin(half) * y, 0.0, cos(half) * y + sin(half) * w, 0.0]
    fixed = frame.seen(3, place)
    after = (fixed - walls.centre[3]) @ WallFrames(later, walls.centre).turned_by(3).T + walls.centre[3]
    told = surface_velocities(walls, np.array([3]), place)
    np.testing.assert_allclose(told, (after - place) / span, rtol=1e-4, atol=1e-6)
    assert walls.reference[3, ARM] > 7e-3
    assert walls.reference[3, ANGLE] >= 0.0


def test_frames_tell_how_walls_are_turned(tmp_path: Path) -> None:
    config = mixer(time={"step": 5e-6, "end": {"time": 10e-3}})
    outcome = run_scene(config, tmp_path / "run")
    with open_run(outcome.folder) as run:
        frame, paddle = run.frame(-1), run.walls["paddle"]
        assert isinstance(paddle, WallMesh)
        angle = 60.0 * (10e-3 - 0.5 * 5e-3)
        c, s = cos(angle), sin(angle)
        expected = np.array([[c * x + s * z, y, -s * x + c * z] for x, y, z in paddle.points])
        np.testing.assert_allclose(paddle.placed(frame), expected, atol=1e-9)
        np.testing.assert_allclose(run.walls["drum"].placed(frame), run.walls["drum"].points)


def test_a_pivot_beside_the_wall_carries_it_round() -> None:
    class Turned:
        wall_displacement = np.array([[0.0, 0.0, 1.0]])
        wall_orientation = np.array([[cos(0.25 * pi), 0.0, sin(0.25 * pi), 0.0]])

    mesh = WallMesh(np.array([[2.0, 0.0, 0.0]]), np.zeros((0, 3), np.int64), 0, np.array([1.0, 0.0, 0.0]))
    np.testing.assert_allclose(mesh.placed(Turned()), [[1.0, 0.0, 0.0]], atol=1e-15)  # type: ignore[arg-type]


def test_stages_about_different_points_are_refused() -> None:
    stages = [TURNING | {"until": {"type": "elapsed", "time": 1e-3}}, TURNING | {"point": [1e-3, 0, 0]}]
    walls = {"drum": DRUM | {"motion": stages}}
    with pytest.raises(ConfigError, match=r"turns about \[0.001, 0.0, 0.0\] m, and one before"):
        mixer(walls=walls)


@pytest.mark.parametrize(("axis", "fits"), [([0, 1, 0], True), ([0, 0, 1], False)])
def test_in_a_periodic_box_a_wall_may_turn_if_it_stays_the_same_in_every_image(axis: list[int], fits: bool) -> None:
    domain = {"lower": [-12e-3, -4e-3, -12e-3], "upper": [12e-3, 4e-3, 12e-3], "periodic": ["y"]}
    walls = {"drum": DRUM | {"motion": TURNING | {"axis": axis}}}
    scene = build_scene(mixer(walls=walls, boundaries={"domain": domain}))
    if fits:
        check_repeats(scene)
    else:
        with pytest.raises(ConfigError, match="not the same in every image"):
            check_repeats(scene)


@pytest.mark.parametrize(("axis", "fits"), [([0, 0, 1], True), ([0, 0, -2], True), ([1, 0, 0], False)])
def test_plates_of_a_compression_turn_about_the_line_between_them_only(axis: list[int], fits: bool) -> None:
    plates = {
        name: {"type": "plane", "material": "glass", "point": [0, 0, -s * 6e-3], "normal": [0, 0, s]}
        for name, s in (("lower", 1), ("upper", -1))
    }
    plates["lower"] |= {"motion": TURNING | {"axis": axis}}
    pressed = {"upper": "upper", "lower": "lower", "height": 12e-3, "diameter": 10e-3}
    config = mixer(walls=plates, compression=pressed)
    if fits:
        Gauge(config)
    else:
        with pytest.raises(ConfigError, match="may turn about the line between the plates only"):
            Gauge(config)
