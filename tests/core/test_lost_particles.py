"""A law of one's own that gives no number is named, with its file, when the run stops."""

from __future__ import annotations

from pathlib import Path

import pytest

from clast import Simulation, load
from clast.errors import RunError
from tests.scenes import write

SCENE = """
name: lost
plugins: [./mine.py]
materials: {glass: {density: 2500, young_modulus: 1e9, poisson_ratio: 0.2}}
particles:
  type: explicit
  material: glass
  particles:
    - {position: [0, 0, 0], radius: 1 mm}
    - {position: [2.1 mm, 0, 0], radius: 1 mm, velocity: [0.1, 0, 0]}
  bonds:
    - {between: [0, 1], diameter: 1 mm}
bonds: {model: {type: MODEL, young_modulus: 1e9, poisson_ratio: 0.2, normal_strength: 1e12}}
contacts: {law: hertz_mindlin, pairs: {default: {restitution: 1}}}
time: {step: 1e-7, end: {steps: 1000}}
"""

MINE = """
from dataclasses import replace
from math import inf

from clast import hookimpl
from clast.parts.bond_model import BondLoad
from clast_plugins.bond_models import elastic

CLAST_API = 1


class Mine(elastic.Elastic):
    "A law that forgets what it is when it is stretched by more than a micrometre."


def no_number(x):
    return x if x < 1e-6 else x * (inf - inf)


def load(strain, c, state):
    found = elastic.load(strain, c, state)
    normal = no_number(strain.axial) * found.normal
    return BondLoad(normal, found.shear, found.torsion, found.bending)


def failure(strain, load, c, state):
    return elastic.failure(strain, load, c, state)


def failure_that_looks_well(strain, load, c, state):
    return 0.0


@hookimpl
def clast_register(registry):
    class Keep:
        def bond_model(self, name, part):
            self.part = part

    keep = Keep()
    elastic.clast_register(keep)
    registry.bond_model("mine", replace(keep.part, Params=Mine, load=load, failure=failure))
    registry.bond_model("sly", replace(keep.part, Params=Mine, load=load, failure=failure_that_looks_well))
"""


@pytest.mark.parametrize(
    ("model", "told"),
    [
        ("mine", r"bond model 'mine' \(.*mine\.py\) gave no number for bond 0 between particles 0 and 1"),
        ("sly", r"look at bond model 'sly' \(.*mine\.py\) and contact law 'hertz_mindlin' \("),
    ],
)
def test_a_law_that_gives_no_number_is_named_with_its_file(tmp_path: Path, model: str, told: str) -> None:
    (tmp_path / "mine.py").write_text(MINE)
    simulation = Simulation(load(write(tmp_path, SCENE.replace("MODEL", model))))
    with pytest.raises(RunError, match=told):
        simulation.advance_to(1000)
