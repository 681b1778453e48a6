"""A registry of fake parts, and a way to load scenes against it."""

from pathlib import Path

import pytest
from fake_parts import SCENE, Ball, Elastic, Explicit, FakePart, Moving, Nothing, Plane

from clast.config import scene as scene_module
from clast.parts.generator import Generator
from clast.plugins.registered import Source
from clast.plugins.registry import Registry


@pytest.fixture
def registry() -> Registry:
    fakes = Registry()
    with fakes.registering(Source("fakes", "fake-distribution", "1.2")):
        fakes.generator("ball", Generator("A ball.", Ball, generate=print))
        fakes.generator("explicit", Generator("Written.", Explicit, generate=print))
        for add, name, declared in [
            (fakes.bond_model, "elastic", Elastic),
            (fakes.bond_kinematics, "total", Nothing),
            (fakes.contact_law, "hertz", Nothing),
            (fakes.rolling_resistance, "constant_torque", Nothing),
            (fakes.integrator, "midstep", Nothing),
            (fakes.integrator, "leapfrog", Nothing),
            (fakes.neighbour_search, "auto", Nothing),
            (fakes.neighbour_search, "linked_cells", Nothing),
            (fakes.wall, "plane", Plane),
            (fakes.writer, "figure", Nothing),
            (fakes.writer, "table", Nothing),
        ]:
            add(name, FakePart(f"The {name}.", declared))
        fakes.motion("moving", FakePart("Moves.", Moving))
    return fakes


@pytest.fixture
def load(registry, tmp_path, monkeypatch):
    """Write a scene to scene.yaml, with some of its text replaced, and load it against the fakes."""
    monkeypatch.setattr(scene_module, "discover", registry.copy)
    monkeypatch.chdir(tmp_path)

    def write_and_load(*replacements, text=SCENE, overrides=()):
        for old, new in replacements:
            assert old in text
            text = text.replace(old, new)
        Path("scene.yaml").write_text(text, encoding="utf-8")
        return scene_module.load("scene.yaml", overrides)

    return write_and_load
