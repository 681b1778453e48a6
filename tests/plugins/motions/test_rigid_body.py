"""Rigid bodies: free or held to an axis, stable whatever they weigh, the same after a resume, refused where endless."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from clast.building import build_scene
from clast.config.scene import SceneConfig, from_mapping, load
from clast.errors import ConfigError, PluginError, RunError
from clast.maths.rotation import IDENTITY, turn
from clast.maths.vec3 import ZERO
from clast.parts.motion import Motion, Pressed, Turned
from clast.parts.params import Params
from clast.plugins.discovery import discover
from clast.results import checkpoint
from clast.scene.compression import Gauge
from clast.scene.start import check_start
from clast.scene.turning import arm
from clast.simulation import Simulation
from clast_plugins.motions.rigid_body import Course, answer, answer_spin, momentum

GLASS = {"glass": {"density": 2500, "young_modulus": 5e6, "poisson_ratio": 0.2}}
BODY = {
    "type": "rigid_body",
    "mass": "20 mg",
    "centre": [0, 0, 4.5e-3],
    "inertia": [2.0e-10, 3.0e-10, 4.0e-10],
    "gravity": [0, 0, -9.81],
}
SLAB = {"type": "block", "material": "glass", "lower": [-6e-3, -4e-3, 4e-3], "upper": [6e-3, 4e-3, 5e-3]}
PLANE = {"type": "plane", "material": "glass", "point": [0, 0, 5e-3], "normal": [0, 0, -1]}
CROWD = [[x, y, 1e-3] for x in (-4e-3, 0.0, 4e-3) for y in (-2.5e-3, 0.1e-3, 2.5e-3)]


def loaded(body: dict[str, Any] | None = None, **more: Any) -> SceneConfig:
    """Return nine spheres on a floor within a rim, and a slab above them that falls on them."""
    return from_mapping(
        {
            "materials": GLASS,
            "particles": {
                "type": "explicit",
                "material": "glass",
                "particles": [{"position": x, "radius": 1e-3} for x in CROWD],
            },
            "contacts": {
                "law": "hertz_mindlin",
                "pairs": {"default": {"restitution": 0.5, "sliding_friction": 0.3, "rolling_friction": 0.1}},
            },
            "walls": {
                "floor": {"type": "plane", "material": "glass", "point": [0, 0, 0], "normal": [0, 0, 1]},
                "rim": {"type": "cylinder", "material": "glass", "point": [0, 0, 0], "axis": [0, 0, 1], "radius": 7e-3},
                "slab": SLAB | {"motion": BODY | (body or {})},
            },
            "body_forces": [{"type": "gravity", "acceleration": [0, 0, -9.81]}],
            "time": {"end": {"time": 60e-3}},
            "output": {"samples": 10, "frames": 2, "writers": []},
        }
        | more
    )


def ran(scene: SceneConfig) -> Simulation:
    simulation = Simulation(scene)
    simulation.advance_to(simulation.last_step)
    return simulation


def test_a_slab_comes_to_rest_on_what_it_falls_on() -> None:
    walls = ran(loaded({"spin": [3.0, 5.0, 0.0]}, time={"end": {"time": 0.25}})).world.walls
    assert 1.9e-3 < float(4e-3 + walls.displacement[2, 2]) < 2.1e-3
    assert np.abs(walls.velocity[2]).max() < 5e-3
    assert np.abs(walls.twist[2, 3:]).max() < 1.0


@pytest.mark.parametrize("weight", [1e-3, 1.0, 100.0])
def test_the_step_is_stable_whatever_the_body_weighs(weight: float) -> None:
    body = {"mass": 2e-5 * weight, "inertia": [weight * each for each in (2e-10, 3e-10, 4e-10)], "gravity": [0, 0, 0]}
    pair = {"default": {"restitution": 1.0, "sliding_friction": 0.0}}
    scene = loaded(
        body | {"velocity": [0, 0, -0.05], "spin": [2.0, 3.0, 1.0]},
        contacts={"law": "hertz_mindlin", "pairs": pair},
        body_forces=[],
        time={"step": {"rule": "spectral", "factor": 0.9}, "end": {"time": 0.1}},
    )
    simulation = Simulation(scene)
    course = scene.walls["slab"].motion
    assert course is not None
    inertia, mass = np.array(course.params.inertia), course.params.mass
    start = 0.5 * mass * 0.05**2 + 0.5 * float(inertia @ np.array([2.0, 3.0, 1.0]) ** 2)
    simulation.advance_to(simulation.last_step)
    v, w = simulation.world.walls.velocity[2], simulation.world.walls.twist[2, 3:]
    held = 0.5 * mass * float(v @ v) + 0.5 * float(inertia.min() * w @ w)
    ledger = simulation.ledger()
    assert held + ledger.stored < 1.2 * start


def test_a_body_turns_about_the_axis_it_is_held_to_alone() -> None:
    held = ran(loaded({"along": [0, 0, 1], "about": [0, 0, 2], "spin": [5.0, 0.0, 7.0]})).world.walls
    assert held.displacement[2, :2].tolist() == [0.0, 0.0]
    assert held.pose[2, 4:6].tolist() == [0.0, 0.0]
    assert held.twist[2, 3:5].tolist() == [0.0, 0.0]
    assert held.pose[2, 6] != 0.0


def test_a_moment_turns_a_body_as_fast_as_its_inertia_lets_it() -> None:
    far = loaded({"centre": [0, 0, 1.0], "gravity": [0, 0, 0], "moment": [0, 0, 4e-9]})
    lifted = far.changed({"walls.slab.lower": [-6e-3, -4e-3, 0.99], "walls.slab.upper": [6e-3, 4e-3, 1.01]})
    simulation = ran(lifted)
    # spin stands in the middle between force evaluations, which with the default scheme is the end of a step
    assert simulation.world.walls.twist[2, 5] == pytest.approx(4e-9 / 4e-10 * simulation.time, rel=1e-9)


def test_a_resumed_run_goes_on_with_the_same_bits(tmp_path: Path) -> None:
    whole, stopped, resumed = (Simulation(loaded({"spin": [3.0, 5.0, 2.0]})) for _ in range(3))
    stopped.advance_to(stopped.last_step // 2)
    checkpoint.save(tmp_path, stopped, {})
    checkpoint.load(tmp_path, resumed)
    for each in (whole, resumed):
        each.advance_to(whole.last_step)
    for name in ("pose", "twist", "moment"):
        np.testing.assert_array_equal(getattr(whole.world.walls, name), getattr(resumed.world.walls, name))
    np.testing.assert_array_equal(whole.world.particles.pose, resumed.world.particles.pose)


def test_a_light_body_leaves_a_smaller_step() -> None:
    heavy, light = (Simulation(loaded({"mass": mass, "inertia": [1e-5 * mass] * 3})) for mass in (1e-2, 1e-6))
    assert light.limits.stable < 0.3 * heavy.limits.stable


def begin(scene: SceneConfig) -> None:
    Gauge(scene)
    check_start(build_scene(scene))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"walls.slab.motion.inertia": [1e-10, 1e-10, 3e-10]}, "no body has these three moments"),
        ({"walls.slab.motion.inertia": [0, 1e-10, 1e-10]}, "no body has these three moments"),
        ({"walls.slab.motion.mass": 0}, "mass: must be greater than 1e-30"),
        (
            {"walls.floor.motion": BODY},
            "walls.floor: a 'plane' has no end, so it has no centre of mass to turn about; take a shape that ends",
        ),
        (
            {
                "boundaries": {"domain": {"lower": [-0.1] * 3, "upper": [0.1] * 3, "periodic": ["x"]}},
                "walls.rim": {"type": "plane", "material": "glass", "point": [0, -0.05, 0], "normal": [0, 1, 0]},
                "walls.slab": PLANE | {"motion": BODY},
            },
            "what turns about another axis is not the same in every image",
        ),
        (
            {"compression": {"upper": "slab", "lower": "floor", "height": 4e-3, "diameter": 12e-3}},
            "a plate of the compression may turn about the line between the plates only",
        ),
    ],
)
def test_what_is_no_body_is_refused(changes: dict[str, Any], said: str) -> None:
    with pytest.raises(ConfigError) as refused:
        begin(loaded().changed(changes))
    assert said in str(refused.value)


def test_a_body_that_turns_too_far_in_a_step_is_told_with_its_name() -> None:
    with pytest.raises(RunError, match=r"the wall 'slab' turns by .* rad in one step"):
        ran(loaded({"spin": [0, 0, 1e5]}))


STAGES = [
    {
        "type": "rotation",
        "axis": [0, 0, 1],
        "point": BODY["centre"],
        "rate": 20.0,
        "until": {"type": "elapsed", "time": 2e-3},
    },
    BODY | {"about": [1, 0, 0], "along": [0, 0, 1]},
]


def test_a_body_that_is_held_stops_what_it_did_before_across() -> None:
    course = Course(2.0, (1.0, 2.0, 3.0), ZERO, ZERO, ZERO, ZERO, (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
    pressed = Pressed((5.0, 5.0, 4.0), 1.0, (1.0, 2.0, 3.0), span=0.1, since=0.1)
    assert answer(course, 0.0, pressed) == pytest.approx((0.0, 0.0, 3.2))
    turned = Turned((4.0, 4.0, 4.0), IDENTITY, (1.0, 2.0, 3.0), span=0.1, since=0.1)
    assert answer_spin(course, 0.0, turned) == pytest.approx((1.4, 0.0, 0.0))


def test_what_a_body_begins_with_is_refused_behind_another_motion() -> None:
    begins = [STAGES[0], BODY | {"spin": [1, 0, 0]}]
    with pytest.raises(
        ConfigError, match=r"motion 1 \(rigid_body\) goes on from what the wall does; leave its velocity"
    ):
        loaded().changed({"walls.slab.motion": begins})


def test_slender_bodies_keep_their_angular_momentum() -> None:
    """A rod that spins fast about its long axis takes many rounds."""
    inertia, dt = (1e-11, 4e-10, 4e-10), 1e-3
    course = Course(1.0, inertia, ZERO, ZERO, ZERO, ZERO, ZERO, ZERO)
    spin, q = (60.0, 50.0, 62.0), IDENTITY
    first = momentum(inertia, q, spin)
    q = turn(q, spin, 0.5 * dt)
    for _ in range(500):
        spin = answer_spin(course, 0.0, Turned(ZERO, q, spin, dt, dt))
        q = turn(q, spin, dt)
    last = momentum(inertia, turn(q, spin, -0.5 * dt), spin)
    assert last == pytest.approx(first, rel=1e-6)


def test_shapes_that_end_tell_how_far_they_reach() -> None:
    walls = loaded().walls
    assert arm(walls["slab"]) == pytest.approx(np.sqrt(36.0 + 16.0 + 0.25) * 1e-3)
    assert arm(walls["floor"]) == arm(walls["rim"]) == np.inf


def test_a_sphere_is_turned_as_momentum_over_inertia() -> None:
    course = Course(1.0, (2.0, 2.0, 2.0), ZERO, (0.0, 1.0, 0.0), ZERO, ZERO, ZERO, ZERO)
    turned = Turned((4.0, 0.0, 0.0), IDENTITY, (0.0, 0.0, 1.0), span=1e-3, since=1e-3)
    assert answer_spin(course, 0.0, turned) == pytest.approx((2e-3, 0.5e-3, 1.0), abs=1e-12)


MOVES = {"answer": lambda c, t, p: ZERO}
KNOWS = {"velocity": lambda c, t: ZERO}
TURNS = {"answer_spin": answer_spin}
ABOUT = {"pivot": lambda p: ZERO}


@pytest.mark.parametrize(
    ("parts", "said"),
    [
        (MOVES | TURNS, "needs both 'spin' or 'answer_spin' and 'pivot', or neither"),
        (MOVES | ABOUT, "needs both 'spin' or 'answer_spin' and 'pivot', or neither"),
        (KNOWS | TURNS | ABOUT, "has 'answer_spin', and no 'answer' to go with it"),
        (KNOWS | {"inverse_mass": lambda c, p: 0.0}, "has 'inverse_mass', and no 'answer' to go with it"),
    ],
)
def test_motions_that_do_not_fit_together_are_refused(parts: dict[str, Any], said: str) -> None:
    with pytest.raises(PluginError, match=said):
        Motion("odd", Params, Course, lambda p: p, **parts)


def test_it_is_among_the_parts() -> None:
    motion = discover().get("motion", "rigid_body").part
    assert motion.turns
    assert load(Path("configs/parts/motion/rigid_body.yaml")).walls["plate"].pivot == (0.0, 0.0, 4.15e-3)
