"""A wall that presses with a given force: on one sphere, on a grain that breaks, from afar, and at any step."""

from __future__ import annotations

from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from clast import Simulation, load
from clast.config.scene import from_mapping
from clast.engine import chunks
from clast.errors import ConfigError, PluginError
from clast.maths.vec3 import ZERO
from clast.parts.motion import Motion, Pressed
from clast.results import checkpoint
from clast_plugins.motions.force_control import Course, ForceControl, answer, course
from tests.scenes import CRUSH, write

DOWN = (0.0, 0.0, -1.0)
SPHERE = {
    "materials": {
        "glass": {"density": 2500, "young_modulus": "100 MPa", "poisson_ratio": 0.25},
        "steel": {"density": 7850, "young_modulus": "210 GPa", "poisson_ratio": 0.3},
    },
    "particles": {
        "type": "explicit",
        "material": "glass",
        "particles": [{"position": [0, 0, "1 mm"], "radius": "1 mm"}],
    },
    "contacts": {"law": "hertz_mindlin", "pairs": {"default": {"restitution": 0.3}}},
    "walls": {
        "floor": {"type": "plane", "material": "steel", "point": [0, 0, 0], "normal": [0, 0, 1]},
        "piston": {
            "type": "plane",
            "material": "steel",
            "point": [0, 0, "2.1 mm"],
            "normal": [0, 0, -1],
            "motion": {"type": "force_control", "direction": [0, 0, -2], "force": "1 N", "max_velocity": "20 mm/s"},
        },
    },
    "time": {"step": "2 us", "end": {"time": "60 ms"}},
    "output": {"writers": [], "ledger": True},
}
PRESSED = [
    "walls.upper.motion={type: force_control, direction: [0, 0, -1], force: 1.5 N, max_velocity: 60 mm/s, ramp: 5 ms}",
    "time.end={time: 15 ms}",
    "output.ledger=true",
]


def sphere(**changes: Any) -> Simulation:
    scene = from_mapping(SPHERE).changed({key.replace("__", "."): value for key, value in changes.items()})
    return Simulation(scene, threads=1)


def ended(simulation: Simulation) -> Simulation:
    simulation.advance_to(simulation.last_step)
    return simulation


pushes = st.floats(-1e3, 1e3)


@given(pushes, pushes, st.floats(-0.1, 0.1), st.floats(0.0, 1.0), st.floats(1e-9, 1e-3))
def test_it_is_never_faster_than_allowed_and_gives_way_to_what_presses_harder(
    one: float, other: float, speed: float, mass: float, span: float
) -> None:
    servo = Course(DOWN, force=10.0, max_velocity=0.1, ramp=0.0)
    soft, hard = (
        -answer(servo, 1.0, Pressed((0.0, 0.0, push), mass, (0.0, 0.0, -speed), span))[2]
        for push in sorted((one, other))
    )
    assert -0.1 <= hard <= soft <= 0.1


def test_it_rests_where_the_force_is_what_it_should_be_and_trails_by_the_share_of_its_speed() -> None:
    servo = Course(DOWN, force=10.0, max_velocity=0.1, ramp=2.0)
    assert answer(servo, 3.0, Pressed((0.0, 0.0, 10.0), 1e-6, ZERO, 1e-6))[2] == 0.0
    assert answer(servo, 1.0, Pressed((0.0, 0.0, 5.0), 1e-6, ZERO, 1e-6))[2] == 0.0
    creeping = Pressed((0.0, 0.0, 7.0), 1e-6, (0.0, 0.0, -0.03), 1e-6)
    assert answer(servo, 3.0, creeping)[2] == pytest.approx(-0.03, rel=1e-12)


def test_a_stress_is_a_force_on_a_disc() -> None:
    pressed = course(ForceControl(direction=(0, 0, -5), stress=2e6, diameter="2 mm", max_velocity=1.0))
    assert pressed.force == pytest.approx(2e6 * np.pi * 1e-6, rel=1e-12)
    assert pressed.direction == DOWN


@pytest.mark.parametrize("integrator", ["midstep", pytest.param("leapfrog", marks=pytest.mark.long), "velocity_verlet"])
def test_one_sphere_is_pressed_as_far_as_hertz_tells(integrator: str) -> None:
    simulation = ended(sphere(integrator=integrator))
    nu, nu_s = 0.25, 0.3
    E = 1.0 / ((1.0 - nu**2) / 100e6 + (1.0 - nu_s**2) / 210e9)
    overlap = (1.0 / (4.0 / 3.0 * E * sqrt(1e-3))) ** (2.0 / 3.0)
    assert simulation.world.walls.force[1, 2] == pytest.approx(1.0, rel=1e-4)
    assert simulation.world.walls.displacement[1, 2] == pytest.approx(-(0.1e-3 + 2.0 * overlap), rel=1e-4)
    assert simulation.world.walls.displacement[1, :2].tolist() == [0.0, 0.0]
    assert abs(simulation.ledger().closure) < 1e-6


def test_from_afar_it_comes_with_its_largest_velocity() -> None:
    simulation = sphere()
    simulation.advance_to(1000)
    before = float(simulation.world.walls.displacement[1, 2])
    simulation.advance_to(2000)
    assert simulation.world.walls.displacement[1, 2] - before == pytest.approx(-0.02 * 2e-3, rel=1e-9)
    assert before == pytest.approx(-0.02 * 2e-3, rel=1e-2)


def test_a_force_that_rises_is_followed() -> None:
    simulation = sphere(walls__piston__motion__ramp="0.2 s", walls__piston__point=[0, 0, 2e-3], time__end={"time": 0.3})
    simulation.advance_to(75_000)
    speed = -float(simulation.world.walls.velocity[1, 2])
    assert simulation.world.walls.force[1, 2] == pytest.approx(0.75 - speed / 0.02, rel=1e-3)
    assert ended(simulation).world.walls.force[1, 2] == pytest.approx(1.0, rel=1e-4)


@pytest.mark.parametrize("speed", [0.02, 2.0])
def test_it_settles_at_a_step_just_below_the_limit_without_any_dashpot_in_the_contacts(speed: float) -> None:
    """The contact with the wall is one of the two springs there are, and nothing damps but the wall."""
    pressed = sphere(contacts__pairs__default__restitution=1.0, walls__piston__motion__max_velocity=speed)
    pressed.advance_to(100_000)
    pressed.change_step(0.95 * pressed.stable_step())
    pressed.world.particles.twist[0, 2] += 1e-3
    pressed.advance_to(pressed.step + 1)
    assert abs(pressed.world.walls.force[1, 2] - 1.0) > 1e-4
    pressed.advance_to(pressed.step + 5000)
    assert pressed.world.walls.force[1, 2] == pytest.approx(1.0, rel=1e-5)
    assert abs(pressed.world.particles.twist[0, 2]) < 1e-5


def test_it_comes_to_rest_however_hard_it_hits() -> None:
    """A wall that took up energy from what it hits would bounce for ever."""
    pressed = sphere(contacts__pairs__default__restitution=1.0, walls__piston__motion__max_velocity=2.0)
    forces = []
    while pressed.step < 5000:
        pressed.advance_to(pressed.step + 5)
        forces.append(pressed.world.walls.force[1, 2])
    assert max(forces) > 2.0
    pressed.advance_to(100_000)
    assert pressed.world.walls.force[1, 2] == pytest.approx(1.0, rel=1e-3)


@pytest.fixture(scope="module")
def broken(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Simulation, Simulation]:
    """Press a small grain until it breaks and holds again; return the scene, the run half-way and at its end."""
    file = write(tmp_path_factory.mktemp("broken"), CRUSH)
    half, whole = (Simulation(load(file, PRESSED), threads=1) for _ in range(2))
    half.advance_to(half.last_step // 2)
    return file, half, ended(whole)


def test_a_force_is_held_through_breakage(broken: tuple[Path, Simulation, Simulation]) -> None:
    _, half, whole = broken
    assert whole.bonds_broken > 10
    assert whole.world.walls.force[0, 2] == pytest.approx(1.5, rel=1e-3)
    assert half.world.walls.force[0, 2] < 1.4
    assert abs(whole.ledger().closure) < 1e-4


def test_it_goes_on_from_a_checkpoint_to_the_same_bytes(
    broken: tuple[Path, Simulation, Simulation], tmp_path: Path
) -> None:
    file, half, whole = broken
    assert abs(half.world.walls.velocity[0, 2]) > 1e-3
    resumed = Simulation(load(file, PRESSED), threads=1)
    checkpoint.save(tmp_path, half, {})
    checkpoint.load(tmp_path, resumed)
    ended(resumed)
    for (name, one), (_, other) in zip(checkpoint.state_arrays(whole), checkpoint.state_arrays(resumed), strict=True):
        assert one.tobytes() == other.tobytes(), name


@pytest.mark.long  # small grains under driven walls tell the same
def test_any_number_of_threads_gives_the_same_bytes(
    broken: tuple[Path, Simulation, Simulation], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(chunks, "SIZE", 16)
    monkeypatch.setattr(chunks, "LARGE", 32)
    one, two = (Simulation(load(broken[0], PRESSED), threads=threads) for threads in (1, 2))
    for simulation in (one, two):
        simulation.advance_to(20_000)
    assert one.world.walls.force[0, 2] > 0.1
    assert one.world.walls.velocity.tobytes() == two.world.walls.velocity.tobytes()
    assert one.world.particles.pose.tobytes() == two.world.particles.pose.tobytes()


@pytest.mark.parametrize(
    ("motion", "said"),
    [
        ({}, "exactly one of force and stress is needed; given neither"),
        ({"force": 1, "stress": 1, "diameter": 1}, "exactly one of force and stress is needed; given both"),
        ({"stress": 1}, "a stress needs a diameter"),
        ({"force": 1, "diameter": 1}, "a diameter needs a stress, not a force"),
        ({"force": "1 Pa"}, "'1 Pa' is a stress; a force is needed"),
        ({"force": -1}, "must be greater than 0"),
    ],
)
def test_what_is_wrong_with_a_load_is_told_with_its_place(motion: dict[str, Any], said: str) -> None:
    given = {"type": "force_control", "direction": [0, 0, -1], "max_velocity": 1} | motion
    with pytest.raises(ConfigError) as told:
        from_mapping(SPHERE).changed({"walls.piston.motion": given})
    assert "walls.piston.motion" in str(told.value)
    assert said in str(told.value)


def test_a_strain_at_the_end_is_refused_with_the_way_out() -> None:
    compression = {"upper": "piston", "lower": "floor", "height": "2 mm", "diameter": "2 mm"}
    scene = from_mapping(SPHERE | {"compression": compression}).changed({"time.end": {"strain": 0.1}})
    with pytest.raises(ConfigError) as told:
        Simulation(scene)
    assert "time.end.strain: walls.piston moves by force_control" in str(told.value)
    assert "give time.end.time instead" in str(told.value)


@pytest.mark.parametrize("given", [{}, {"velocity": answer, "answer": answer}])
def test_a_motion_either_knows_its_velocity_or_answers(given: dict[str, Any]) -> None:
    with pytest.raises(PluginError, match=r"motion 'drifts' needs either 'velocity' or 'answer'"):
        Motion("drifts", ForceControl, Course, course, **given)
