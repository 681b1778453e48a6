"""A scene of two bonded spheres that tests of messages spoil, and the command that tells what is wrong with it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from click.testing import CliRunner, Result

from clast.cli import main

PAIR = """\
materials:
  glass: {density: 2500 kg/m3, young_modulus: 100 MPa, poisson_ratio: 0.25}
  steel: {density: 7850 kg/m3, young_modulus: 210 GPa, poisson_ratio: 0.3}
particles:
  type: explicit
  material: glass
  particles:
    - {position: [-1.1 mm, 0, 0], radius: 1 mm}
    - {position: [1.1 mm, 0, 0], radius: 1 mm}
  bonds:
    - {between: [0, 1], diameter: 1 mm}
bonds:
  model: {type: elastic, young_modulus: 100 MPa, poisson_ratio: 0.2, normal_strength: 1 MPa, shear_strength: 1 MPa}
contacts:
  law: hertz_mindlin
  pairs:
    default: {restitution: 0.5}
walls:
  floor: {type: plane, material: steel, point: [0, 0, -1 mm], normal: [0, 0, 1]}
time:
  step: 1e-7 s
  end: {steps: 10}
output: {writers: []}
"""
FILES = """\
  type: from_file
  particles: grain.csv
  bonds: bonds.csv
  material: glass
"""
EXPLICIT = PAIR[PAIR.index("  type: explicit") : PAIR.index("bonds:\n  model")]
GRAIN = """\
  type: spherical_agglomerate
  material: glass
  diameter: 0.75 mm
  primary_diameter: 0.25 mm
  porosity: 0.3
"""


def clast(*arguments: Any) -> Result:
    return CliRunner().invoke(main, [str(each) for each in arguments])


def scene(*replacements: tuple[str, str]) -> str:
    """Write the scene with some of its text replaced."""
    text = PAIR
    for old, new in replacements:
        assert old in text
        text = text.replace(old, new)
    Path("scene.yaml").write_text(text)
    return "scene.yaml"


def table(name: str, text: str) -> None:
    Path(name).write_text(text)


def said(result: Result, exit_code: int = 2) -> str:
    """Return the one message of a command that failed as it should."""
    assert isinstance(result.exception, SystemExit), result.exception
    assert result.exit_code == exit_code
    assert "Traceback" not in result.output
    return result.stderr.removesuffix("\n")
