"""Gravity."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import AccelerationVector
from clast.maths.vec3 import Vec, scale
from clast.parts.body_force import BodyForce
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Gravity(Params):
    """The same acceleration for all particles; mass scaling divides it, so that weights stay what they are.

    Source: Rotter, Dosta, Düster (2023), Section 4.1.1, mass scaling.
    """

    acceleration: Annotated[AccelerationVector, Field(examples=[[0, 0, -9.81]], description="Acceleration of gravity")]


class Numbers(NamedTuple):
    """Acceleration in m/s²."""

    acceleration: Vec


def numbers(params: Gravity, mass_scaling: float) -> Numbers:
    """Return the acceleration of the scaled masses."""
    return Numbers(scale(1.0 / mass_scaling, params.acceleration))


def acceleration(numbers: Numbers, x: Vec, v: Vec, time: float) -> Vec:
    """Return the acceleration in m/s²."""
    return numbers.acceleration


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer gravity."""
    registry.body_force(
        "gravity",
        BodyForce(
            summary="the same acceleration for all particles",
            Params=Gravity,
            Numbers=Numbers,
            numbers=numbers,
            acceleration=acceleration,
        ),
    )
