"""Walls that forces move: they touch particles that nothing moves, and contacts know how they give way."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given

from clast import run_scene
from clast.building import build_scene
from clast.config.scene import SceneConfig, from_mapping
from clast.errors import ConfigError, RunError
from clast.maths.vec3 import ZERO, add, cross, dot, scale
from clast.parts.motion import Pressed, Pushed, Turned
from clast.plugins.discovery import discover
from clast.scene.start import check_start
from clast.simulation import Simulation
from clast.testing.claim import try_claims
from clast.testing.draws import directions, rotations, vectors
from clast.testing.motion import claims
from clast_plugins.motions import free, rigid_body

RADIUS, GAP, SPEED, RESTITUTION = 1e-3, 1e-5, 0.1, 0.6
APART = 0.1
"""Distance in m of the places at which one wall each meets one sphere."""
MASS = 4.0 / 3.0 * np.pi * RADIUS**3 * 2500.0
FREE = {"type": "free", "mass": MASS, "velocity": [0.0, 0.0, -SPEED]}
PRESS = {"type": "force_control", "direction": [0.0, 0.0, -1.0], "force": 0.5, "max_velocity": SPEED}


def block(place: int, **motion: Any) -> dict[str, Any]:
    x, z = place * APART, 2.0 * RADIUS + GAP
    shape = {"type": "block", "lower": [x - 5e-3, -4e-3, z], "upper": [x + 5e-3, 4e-3, z + 1e-3]}
    return shape | {"material": "glass", "motion": motion}


def meetings(weight: float = 1.0, end: float = 4e-3, **more: Any) -> SceneConfig:
    """Return a lid above a sphere that is held, one above a free sphere, and a plate that presses on a held one."""
    held = [True, False, True]
    return from_mapping(
        {
            "materials": {"glass": {"density": 2500.0, "young_modulus": 5e7, "poisson_ratio": 0.2}},
            "particles": {
                "type": "explicit",
                "material": "glass",
                "particles": [
                    {"position": [k * APART, 0.0, RADIUS], "radius": RADIUS, "fixed": fixed}
                    for k, fixed in enumerate(held)
                ],
            },
            "contacts": {
                "law": "hertz_mindlin",
                "pairs": {"default": {"restitution": RESTITUTION, "sliding_friction": 0.0}},
            },
            "walls": {
                "anvil": block(0, **FREE | {"mass": weight * MASS}),
                "lid": block(1, **FREE | {"mass": weight * MASS}),
                "press": block(2, **PRESS),
            },
            "time": {"end": {"time": end}},
            "output": {"writers": []},
        }
        | more
    )


@pytest.mark.parametrize("weight", [0.01, 1.0, 100.0])
def test_the_coefficient_of_restitution_is_the_one_written_whatever_the_wall_weighs(weight: float) -> None:
    simulation = Simulation(meetings(weight))
    simulation.advance_to(simulation.last_step)
    (anvil, _, _), (lid, _, _) = simulation.world.walls.velocity[:2, ::-1]
    flown_off = float(simulation.world.particles.twist[1, 2])
    assert anvil == pytest.approx(RESTITUTION * SPEED, rel=0.01)
    assert lid - flown_off == pytest.approx(RESTITUTION * SPEED, rel=0.01)
    assert weight * lid + flown_off == pytest.approx(-weight * SPEED, rel=1e-9)
    assert not simulation.world.particles.twist[[0, 2]].any()


def bed(weight: float, restitution: float) -> SceneConfig:
    """Return 5 x 5 spheres that are held, and a lid that lands on all of them at once."""
    spheres = [
        {"position": [2.2e-3 * (k % 5), 2.2e-3 * (k // 5), RADIUS], "radius": RADIUS, "fixed": True} for k in range(25)
    ]
    plate = {"lower": [-5e-3, -5e-3, 2.0 * RADIUS + GAP], "upper": [14e-3, 14e-3, 3e-3]}
    walls = {"lid": block(0, **FREE | {"mass": weight * MASS}) | plate, "press": block(2, **PRESS)}
    law = {"law": "hertz_mindlin", "pairs": {"default": {"restitution": restitution, "sliding_friction": 0.0}}}
    return meetings().changed({"particles.particles": spheres, "walls": walls, "contacts": law, "time.end.time": 2e-3})


@pytest.mark.parametrize("weight", [0.1, 1.0, 100.0])
@pytest.mark.parametrize("restitution", [0.0, 0.6])
def test_a_lid_that_lands_on_many_at_once_comes_back_as_from_one(weight: float, restitution: float) -> None:
    simulation = Simulation(bed(weight, restitution))
    simulation.advance_to(simulation.last_step)
    assert float(simulation.world.walls.velocity[0, 2]) == pytest.approx(restitution * SPEED, abs=0.03 * SPEED)


def test_a_plate_presses_on_a_held_sphere_with_the_force_that_it_should() -> None:
    simulation = Simulation(meetings(end=20e-3))
    simulation.advance_to(simulation.last_step)
    assert simulation.world.walls.force[2, 2] == pytest.approx(PRESS["force"], rel=1e-3)


@pytest.mark.parametrize("weight", [1e-3, 1.0, 100.0])
def test_a_lid_comes_to_rest_on_a_held_sphere_in_steps_just_below_the_limit(weight: float) -> None:
    loaded = FREE | {"mass": weight * MASS, "force": [0.0, 0.0, -0.5]}
    walls = {"anvil": block(0, **loaded), "lid": block(1, **FREE), "press": block(2, **PRESS)}
    steps = {"time": {"end": {"time": 15e-3}, "step": {"rule": "spectral", "factor": 0.95}}}
    simulation = Simulation(meetings(walls=walls, **steps))
    simulation.advance_to(simulation.last_step)
    assert simulation.world.walls.force[0, 2] == pytest.approx(0.5, rel=0.02)
    assert float(np.abs(simulation.world.walls.velocity[0]).max()) < 0.02 * SPEED


def test_a_wall_that_starts_inside_a_held_particle_is_refused() -> None:
    scene = meetings(walls={"anvil": block(0, **FREE) | {"lower": [-5e-3, -4e-3, 1.5e-3]}})
    with pytest.raises(ConfigError, match=r"walls\.anvil: particle 0 .*into this wall at the start"):
        check_start(build_scene(scene))


def test_a_wall_that_is_driven_passes_through_held_particles() -> None:
    down = {"type": "constant_velocity", "velocity": [0.0, 0.0, -SPEED]}
    simulation = Simulation(meetings(walls={"anvil": block(0, **down), "lid": block(1, **FREE)}))
    simulation.advance_to(simulation.last_step)
    assert not simulation.world.walls.force[0].any()


def test_a_wall_that_was_driven_into_held_particles_is_not_let_go_there(tmp_path: Path) -> None:
    stages = [
        {
            "type": "constant_velocity",
            "velocity": [0.0, 0.0, -SPEED],
            "until": {"type": "elapsed", "time": 1e-3},
        },
        {"type": "free", "mass": MASS},
    ]
    walls = {"anvil": block(0) | {"motion": stages}, "press": block(2, **PRESS)}
    with pytest.raises(RunError, match=r"walls\.anvil: as its motion 2 begins, .* inside particle 0, which nothing"):
        run_scene(meetings(walls=walls), tmp_path / "run")


def test_a_wall_pushes_nothing_that_is_held_where_it_cannot_give_way() -> None:
    aside = FREE | {"velocity": [0.0, 0.0, 0.0], "along": [1.0, 0.0, 0.0]}
    more = {"contacts": {"law": "hertz_mindlin", "start_overlap": 1.0, "pairs": {"default": {"restitution": 0.6}}}}
    into = block(0, **aside) | {"lower": [-5e-3, -4e-3, 1.99e-3]}
    simulation = Simulation(meetings(walls={"anvil": into}, **more))
    simulation.advance_to(simulation.last_step)
    assert not simulation.world.walls.force[0].any()


def test_a_motion_that_tells_otherwise_than_it_moves_is_found() -> None:
    def heavier(course: Any, pushed: Pushed) -> float:
        return 0.5 * free.inverse_mass(course, pushed)

    def all_of_it(course: Any, mass: float, reach: float) -> float:
        return 2.0

    motion, params = discover().get("motion", "free").part, free.Free(mass=0.1)
    for name, wrong, said in (
        ("inverse_mass", heavier, "it is 5 /kg, and a short push moves it by 10 m/s"),
        ("step_share", all_of_it, "for particles of 1e-9 to 1 kg it is"),
    ):
        found = try_claims(claims(replace(motion, **{name: wrong}), params))
        assert any(said in outcome.problem for outcome in found)


@given(directions(), vectors(5e-3), rotations(), directions(), directions())
@pytest.mark.parametrize("held", [(), ("along",), ("about",), ("along", "about")])
def test_a_body_gives_way_as_one_push_moves_and_turns_it(held, normal, arm, q, along, about):
    """Besides, a push changes the spin by how the body turns meanwhile, which a short span does not."""
    ways = {"along": along if "along" in held else ZERO, "about": about if "about" in held else ZERO}
    course = rigid_body.Course(2e-5, (2e-10, 3e-10, 4e-10), ZERO, ZERO, ZERO, ZERO, **ways)
    impulse, span = 1e-12, 1e-9
    push = scale(impulse / span, normal)
    moved = rigid_body.answer(course, 0.0, Pressed(push, 1.0, ZERO, span, span))
    turned = rigid_body.answer_spin(course, 0.0, Turned(cross(arm, push), q, ZERO, span, span))
    gained = dot(normal, add(moved, cross(turned, arm))) / impulse
    told = rigid_body.inverse_mass(course, Pushed(normal, arm, q, 1.0))
    assert told == pytest.approx(gained, rel=1e-6, abs=1e-3)
