"""What is odd about a wall that forces move is said before it runs: whom it passes through, where it turns about."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from clast.building import build_scene
from clast.config.scene import SceneConfig, from_mapping
from clast.scene.concerns import concerns
from clast.soundness.suspects import answering

CENTRE = (0.0, 0.0, 4.15e-3)


def told(
    centre: tuple[float, float, float] = CENTRE,
    motion: str = "rigid_body",
    plugins: tuple[str, ...] = (),
    heavier: float = 1.0,
    **held: bool,
) -> list[str]:
    """Return what is said of a plate above one sphere."""
    scene = plated(centre, motion, plugins, heavier, **held)
    return [text for text in concerns(build_scene(scene)) if "walls.plate" in text]


def plated(
    centre: tuple[float, float, float] = CENTRE,
    motion: str = "rigid_body",
    plugins: tuple[str, ...] = (),
    heavier: float = 1.0,
    **held: bool,
) -> SceneConfig:
    """Return a plate above one sphere."""
    body: dict[str, Any] = {"mass": 6e-5, "gravity": [0.0, 0.0, -9.81]}
    if motion == "rigid_body":
        body |= {"centre": list(centre), "inertia": [3.2e-10 * heavier, 5.0e-10 * heavier, 8.2e-10 * heavier]}
    wall: dict[str, Any] = {"type": "block", "lower": [-5e-3, -4e-3, 4e-3], "upper": [5e-3, 4e-3, 4.3e-3]}
    wall |= {"material": "glass"} | ({"motion": {"type": motion, **body}} if motion else {})
    ground = {"type": "plane", "point": [0.0, 0.0, 0.0], "normal": [0.0, 0.0, 1.0], "material": "glass"}
    scene = {
        "plugins": list(plugins),
        "materials": {"glass": {"density": 2500.0, "young_modulus": 2e7, "poisson_ratio": 0.2}},
        "particles": {
            "type": "explicit",
            "material": "glass",
            "particles": [{"position": [0.0, 0.0, 1e-3], "radius": 1e-3, **held}],
        },
        "contacts": {"law": "hertz_mindlin", "pairs": {"default": {"restitution": 0.3, "sliding_friction": 0.5}}},
        "walls": {"plate": wall, "ground": ground},
        "time": {"end": {"time": 0.04}},
    }
    return from_mapping(scene)


SILENT = '''"""A wall that forces move, and whose motion says nothing of how it gives way."""

from clast import hookimpl
from clast.parts.motion import Motion
from clast_plugins.motions.free import Course, Free, answer, course

CLAST_API = 1


class Light(Free):
    """A lid."""


@hookimpl
def clast_register(registry):
    registry.motion("light", Motion("a lid", Light, Course, course, answer=answer))
'''


def test_bodies_that_pass_through_held_particles_are_named(tmp_path: Path) -> None:
    silent = tmp_path / "light.py"
    silent.write_text(SILENT)
    (text,) = told(motion="light", plugins=(str(silent),), fixed=True)
    assert "1 particles are fixed or have a prescribed velocity, and the motion 'light' does not say" in text
    assert told(motion="light", plugins=(str(silent),)) == []
    assert told(fixed=True) == told(motion="free", fixed=True) == told(motion="", fixed=True) == []


def test_a_centre_far_outside_its_shape_is_pointed_out() -> None:
    (text,) = told(centre=(1.0, 0.0, 0.0))
    assert "its centre of mass lies 0.995 m away from its shape, which is 0.0128 m long" in text
    assert told(centre=(5e-3, 4e-3, 8e-3)) == []


def test_moments_of_inertia_that_no_such_shape_can_have_are_pointed_out() -> None:
    """All of 60 mg at the corners, 6.4 mm away from the middle, would have 2.46e-9 kg m²."""
    assert told(heavier=2.9) == []
    (text,) = told(heavier=3.1)
    assert "moments of inertia is 2.54e-09 kg m2, and if all of its mass lay at its farthest place it would be" in text


def test_motions_of_ones_own_are_suspected_where_a_particle_at_a_wall_is_lost(tmp_path: Path) -> None:
    mine = tmp_path / "light.py"
    mine.write_text(SILENT.replace("answer=answer", "answer=answer, inverse_mass=lambda c, pushed: 0.0"))
    (found,) = answering(plated(motion="light", plugins=(str(mine),)))
    assert found.name == "light"
    assert answering(plated(motion="free")) == answering(plated(motion="")) == []
