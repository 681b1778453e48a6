"""Particles of one size: their common radius and mass, read once, give the bits that each pair's own would give."""

from __future__ import annotations

from pathlib import Path

import pytest

from clast import load
from clast.building import build_scene
from clast.scene import plan
from clast.simulation import Simulation
from tests.scenes import COLLISION, CRUSH, write


def pressed(folder: Path) -> Simulation:
    simulation = Simulation(load(write(folder, CRUSH), ["walls.upper.motion.velocity=[0, 0, -0.1]"]))
    simulation.advance_to(3000)
    return simulation


def test_one_size_is_left_to_the_scene_not_to_the_pair(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    once = pressed(tmp_path)
    monkeypatch.setattr(plan, "_one_size", lambda scene: False)
    each = pressed(tmp_path)
    assert once.plan.contacts is not None
    assert each.plan.contacts is not None
    assert (once.plan.contacts.one_size, each.plan.contacts.one_size) == (True, False)
    assert once.world.pairs.touching.any()
    for name in ("pose", "twist", "load"):
        assert getattr(once.world.particles, name).tobytes() == getattr(each.world.particles, name).tobytes()


@pytest.mark.parametrize(
    ("change", "one"),
    [
        ("particles.particles.1.material=glass", True),
        ("particles.particles.1.radius=1.5 mm", False),
        ("particles.particles.1.prescribed=true", False),
        ("time.selective_mass_scaling=1 us", True),
    ],
)
def test_what_makes_particles_differ(tmp_path: Path, change: str, one: bool) -> None:
    scene = build_scene(load(write(tmp_path, COLLISION), [change]))
    contacts = plan.blueprint(scene).contacts
    assert contacts is not None
    assert contacts.one_size is one
