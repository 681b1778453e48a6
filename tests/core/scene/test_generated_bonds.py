"""Bonds that make no sense are refused in one place, whichever generator brought them."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.scenes import write

from clast import load
from clast.building import build_scene
from clast.errors import ConfigError

HEAD = """
materials: {glass: {density: 2500, young_modulus: 1e9, poisson_ratio: 0.2}}
bonds: {model: {type: elastic, young_modulus: 1e9, poisson_ratio: 0.2, normal_strength: 1e9}}
time: {step: 1e-7, end: {steps: 1}}
"""

EXPLICIT = """
particles:
  type: explicit
  material: glass
  particles:
    - {position: [0, 0, 0], radius: 1 mm}
    - {position: [2 mm, 0, 0], radius: 1 mm}
  bonds:
    - {between: [0, 1], diameter: 1 mm}
    - {between: BETWEEN, diameter: 1 mm}
"""

FROM_FILE = "particles: {type: from_file, material: glass, particles: p.csv, bonds: b.csv}\n"

THIRD_PARTY = """
plugins: [./pair.py]
particles: {type: pair, ends: [[0, 1], ENDS]}
"""

PAIR = """
import numpy as np

from clast import hookimpl
from clast.parts.generator import BondList, Generator, Packing
from clast.parts.params import Params

CLAST_API = 1


class Pair(Params):
    ends: list[tuple[int, int]]


def generate(params, folder):
    x = np.array([[0.0, 0.0, 0.0], [2e-3, 0.0, 0.0]])
    bonds = BondList(np.array(params.ends), np.full(len(params.ends), 1e-3), np.full(len(params.ends), np.nan))
    still, loose = np.zeros((2, 3)), np.zeros(2, bool)
    return Packing(x, np.full(2, 1e-3), ["glass"] * 2, still, still, loose, np.zeros(2, int), bonds=bonds)


@hookimpl
def clast_register(registry):
    registry.generator("pair", Generator(summary="a pair", Params=Pair, generate=generate))
"""


def refusal(folder: Path, text: str) -> str:
    """Return what is said of a scene that cannot be built."""
    (folder / "pair.py").write_text(PAIR)
    with pytest.raises(ConfigError) as error:
        build_scene(load(write(folder, HEAD + text)))
    return str(error.value)


@pytest.mark.parametrize("between", ["[0, 1]", "[1, 0]"])
def test_a_doubled_bond_in_the_scene_is_told_with_its_key(tmp_path: Path, between: str) -> None:
    told = refusal(tmp_path, EXPLICIT.replace("BETWEEN", between))
    assert "particles.bonds.1.between" in told
    assert "as bond 0 does already (particles.bonds.0.between); remove one of them" in told


@pytest.mark.parametrize("row", ["7,3", "3,7"])
def test_a_doubled_bond_in_a_table_is_told_with_both_lines(tmp_path: Path, row: str) -> None:
    (tmp_path / "p.csv").write_text("id,x,y,z,radius\n7,0,0,0,1e-3\n3,2e-3,0,0,1e-3\n")
    (tmp_path / "b.csv").write_text(f"i,j,diameter\n7,3,1e-3\n\n{row},1e-3\n")
    told = refusal(tmp_path, FROM_FILE)
    assert "b.csv:4: bond 1 connects particles" in told
    assert f"as bond 0 does already ({tmp_path / 'b.csv'}:2)" in told


@pytest.mark.parametrize(
    ("ends", "told"),
    [
        ("[0, 1]", "as bond 0 does already"),
        ("[1, 0]", "as bond 0 does already"),
        ("[1, 1]", "one with itself; two different particles are needed"),
        ("[0, 2]", "bond 1 connects particles 0 and 2, counted from 0, but the last is 1"),
        ("[-1, 0]", "but the last is 1"),
    ],
)
def test_senseless_bonds_of_anybodys_generator_are_refused(tmp_path: Path, ends: str, told: str) -> None:
    assert told in refusal(tmp_path, THIRD_PARTY.replace("ENDS", ends))
