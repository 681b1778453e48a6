"""What is told of particles that nothing holds."""

from __future__ import annotations

from typing import Any

import pytest

from clast.building import build_scene
from clast.config.scene import from_mapping
from clast.scene.held import not_held

BOTTOM = {"type": "plane", "material": "glass", "point": [0, 0, -0.01], "normal": [0, 0.1, 1]}
TUBE = {"type": "cylinder", "material": "glass", "point": [0, 0, 0], "axis": [0, 0, 1], "radius": 0.02}
BOX = {"type": "box", "material": "glass", "lower": [-0.02] * 3, "upper": [0.02] * 3}
PISTON = {"type": "plane", "material": "glass", "point": [0, 0, 0.02], "normal": [0, 0, -1]}
DOWN = {"type": "constant_velocity", "velocity": [0, 0, -0.1]}
RAMP = {"type": "velocity_ramp", "end": [0, 0, -0.1], "duration": "1 ms"}
SERVO = {"type": "force_control", "direction": [0, 0, -1], "force": "1 N", "max_velocity": "1 mm/s"}
RESTING = {
    "type": "explicit",
    "material": "glass",
    "particles": [{"position": [0, 0, 2.1e-3 * k], "radius": 1e-3, "fixed": k == 0} for k in range(4)],
}
"""A row of spheres on one that nothing moves."""
GRAVITY = [{"type": "gravity", "acceleration": [0, 0, -9.81]}]


def told(walls: dict[str, Any], **more: Any) -> list[str]:
    spheres = [{"position": [x, y, 0], "radius": 1e-3} for x in (-5e-3, 0, 19e-3) for y in (0, 3e-3)]
    scene = {
        "materials": {"glass": {"density": 1000, "young_modulus": 1e8, "poisson_ratio": 0.2}},
        "particles": {"type": "explicit", "material": "glass", "particles": spheres[:5]},
        "contacts": {"law": "hertz_mindlin", "pairs": {"default": {"restitution": 0.5}}},
        "walls": walls,
        "time": {"end": {"steps": 1}},
    }
    return not_held(build_scene(from_mapping(scene | more)))


@pytest.mark.parametrize(
    ("walls", "more", "sentence"),
    [
        ({"tube": TUBE}, {"body_forces": GRAVITY}, "nothing holds the particles against body_forces.0 (gravity)"),
        ({"tube": TUBE, "piston": PISTON | {"motion": DOWN}}, {}, "nothing holds the particles against walls.piston"),
        ({"tube": TUBE, "piston": PISTON | {"motion": RAMP}}, {}, "nothing holds the particles against walls.piston"),
        ({"tube": TUBE, "piston": PISTON | {"motion": SERVO}}, {}, "nothing holds the particles against walls.piston"),
        (
            {"tube": TUBE, "bottom": BOTTOM | {"type": "disc", "radius": 1e-3}},
            {"body_forces": GRAVITY},
            "nothing holds the particles",
        ),
    ],
)
def test_a_tube_without_a_bottom_is_pointed_out(walls: dict[str, Any], more: dict[str, Any], sentence: str) -> None:
    (found,) = told(walls, **more)
    assert found.startswith(sentence)


@pytest.mark.parametrize(
    ("walls", "more"),
    [
        ({"tube": TUBE, "bottom": BOTTOM}, {"body_forces": GRAVITY}),
        ({"tube": TUBE, "bottom": BOTTOM, "piston": PISTON | {"motion": DOWN}}, {}),
        ({}, {"body_forces": GRAVITY}),
        ({"tube": TUBE}, {}),
        ({"vessel": BOX | {"motion": DOWN}}, {"body_forces": GRAVITY}),
        ({"tube": TUBE}, {"body_forces": GRAVITY, "particles": RESTING}),
        ({"tube": TUBE}, {"body_forces": GRAVITY, "boundaries": {"domain": {"lower": [-1] * 3, "upper": [1] * 3}}}),
    ],
)
def test_what_is_held_or_free_on_purpose_is_not_talked_about(walls: dict[str, Any], more: dict[str, Any]) -> None:
    assert told(walls, **more) == []
