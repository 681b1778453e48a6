"""A law that is edited on disk gives new numbers in the next run, whatever was compiled before."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from clast.engine.slots_text import slots_text
from clast.errors import PluginError
from clast.scene.plan import blueprint

LAW = """\
from typing import NamedTuple

from clast import hookimpl
from clast.maths.vec3 import ZERO
from clast.parts.bond_model import BondLoad, BondModel, Stiffness
from clast.parts.params import Params

CLAST_API = 1
SPRING = 1000.0


class Constants(NamedTuple):
    area: float


def constants(params, bond):
    return Constants(bond.A)


def stiffness(params, bond):
    k = 0.0 * bond.L0 + SPRING
    return Stiffness(k, k, k, k)


def load(strain, c, state):
    return BondLoad(SPRING * strain.axial, ZERO, 0.0, ZERO)


def failure(strain, load, c, state):
    return 0.0


def mode(strain, load, c, state):
    return 0


def energy(strain, c, state):
    return 0.5 * SPRING * strain.axial * strain.axial


@hookimpl
def clast_register(registry):
    registry.bond_model(
        "spring",
        BondModel("a spring", Params, Constants, constants, stiffness, load, failure, mode, energy, ("never",)),
    )
"""

SCENE = """\
plugins: [./law.py]
materials:
  glass: {density: 2500 kg/m3, young_modulus: 1 GPa, poisson_ratio: 0.2}
particles:
  type: explicit
  material: glass
  particles:
    - {position: [0, 0, 0], radius: 1 mm, fixed: true}
    - {position: [3 mm, 0, 0], radius: 1 mm, prescribed: true, velocity: [1 m/s, 0, 0]}
  bonds:
    - {between: [0, 1], diameter: 1 mm}
bonds: {model: spring}
integrator: velocity_verlet
time: {step: 1 us, end: {steps: 100}}
"""

RUN = """\
from clast import Simulation, load

simulation = Simulation(load("scene.yaml"))
simulation.run()
print(simulation.kernel.fresh, float(simulation.bond_loads()[0, 2]))
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "scene.yaml").write_text(SCENE)
    return tmp_path


def force(folder: Path, law: str) -> tuple[bool, float]:
    """Run the scene with a law in a new interpreter; return whether it compiled, and the bond's normal force in N."""
    (folder / "law.py").write_text(law)
    told = subprocess.run(
        [sys.executable, "-c", RUN],
        cwd=folder,
        env=os.environ | {"CLAST_CACHE": str(folder / "cache")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert told.returncode == 0, told.stderr
    fresh, newtons = told.stdout.split()
    return fresh == "True", float(newtons)


def test_an_edited_law_gives_new_numbers_and_the_old_one_is_still_known(folder):
    stretched = 1e-4
    fresh, before = force(folder, LAW)
    assert fresh
    assert before == pytest.approx(1000.0 * stretched, rel=1e-9)
    fresh, edited = force(folder, LAW.replace("SPRING = 1000.0", "SPRING = 2500.0"))
    assert fresh
    assert edited == pytest.approx(2500.0 * stretched, rel=1e-9)
    assert force(folder, LAW) == (False, before)


def test_a_law_written_as_a_lambda_is_refused_in_plain_words(folder):
    from clast.building import build_scene
    from clast.config.scene import load

    text = LAW.replace("constants, stiffness, load,", "constants, stiffness, lambda s, c, state: None,")
    (folder / "law.py").write_text(text)
    plan = blueprint(build_scene(load(folder / "scene.yaml")))
    with pytest.raises(PluginError, match=r"lambda.* is not a function at the top level of a file; write it there"):
        slots_text(plan)
