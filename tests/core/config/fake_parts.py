"""Fake parts, and a scene made of them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from clast.config.quantities import Direction, Length, Point, Stress, VelocityVector
from clast.parts.params import Params

SCENE = """\
materials:
  glass: {density: 2500 kg/m3, young_modulus: 70 GPa, poisson_ratio: 0.2}
  steel: {density: 7850 kg/m3, young_modulus: 210 GPa, poisson_ratio: 0.3}
particles:
  type: ball
  material: glass
  primary_diameter: 0.25 mm
  seed: 1
bonds:
  between: {max_gap: 0.1 mm}
  model: {type: elastic, young_modulus: 5 MPa}
contacts:
  law: hertz
  pairs:
    default: {restitution: 0.5}
walls:
  upper: {type: plane, material: steel, point: [0, 0, 1 mm], motion: {type: moving, velocity: [0, 0, -0.01]}}
  lower: {type: plane, material: steel, point: [0, 0, -1 mm]}
compression: {upper: upper, lower: lower, height: 2 mm, diameter: 2 mm}
time:
  step: 5e-7
  end: {strain: 0.25}
"""


class Nothing(Params):
    pass


class Ball(Params):
    material: str
    primary_diameter: Annotated[Length, Field(gt=0, description="Diameter of a primary")]
    seed: Annotated[int, Field(ge=0, description="Seed")] = 0
    file: Path | None = None


class Grain(Params):
    position: Point
    material: str


class Explicit(Params):
    grains: Annotated[tuple[Grain, ...], Field(min_length=1, description="The grains")]


class Elastic(Params):
    young_modulus: Annotated[Stress, Field(gt=0, description="Young's modulus")]
    failure: Annotated[Literal["brittle", "ductile"], Field(description="How it breaks")] = "brittle"


class Plane(Params):
    point: Annotated[Point, Field(description="A point of the plane")]
    normal: Direction = (0.0, 0.0, 1.0)


class Moving(Params):
    velocity: VelocityVector


@dataclass(frozen=True)
class FakePart:
    summary: str
    Params: type[Params]
