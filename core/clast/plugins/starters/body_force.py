"""Starter: a spring that pulls every particle to a point."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Point, Unit
from clast.maths.vec3 import Vec, scale, sub
from clast.parts.body_force import BodyForce
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """A pull towards a point that grows with the distance.

    Equation
    --------
    a = −ω² (x − x_0)

    Source
    ------
    The harmonic oscillator.
    """

    centre: Annotated[Point, Field(examples=[[0, 0, 0]], description="Point x_0 that pulls")]
    frequency: Annotated[float, Unit("rad/s"), Field(gt=0, examples=[10.0], description="Angular frequency ω")]


class Numbers(NamedTuple):
    """Centre in m, and ω² in 1/s²."""

    centre: Vec
    omega2: float


def numbers(params: Starter, mass_scaling: float) -> Numbers:
    """Return what the compiled loop needs; with scaled masses a force gives 1/``mass_scaling`` of its acceleration."""
    return Numbers(params.centre, params.frequency**2 / mass_scaling)


def acceleration(known: Numbers, x: Vec, v: Vec, time: float) -> Vec:
    """Return the acceleration of a particle in m/s²."""
    return scale(-known.omega2, sub(x, known.centre))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the force."""
    registry.body_force("starter", BodyForce("a pull to a point", Starter, Numbers, numbers, acceleration))
