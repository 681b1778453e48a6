"""Starter: damping in proportion to mass and velocity."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Frequency, Number
from clast.maths.vec3 import Vec, scale
from clast.parts.damping import Damping
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """A drag in proportion to mass and velocity, as of a liquid that is everywhere at rest.

    Equation
    --------
    a_d = −c v

    Source
    ------
    Mass-proportional damping of dynamic relaxation.
    """

    rate: Annotated[Frequency, Field(gt=0, examples=[0.5], description="Rate c at which velocities decay")]
    ratio: Annotated[
        Number, Field(ge=0, examples=[0.5], description="Damping ratio that the fastest vibration may get")
    ] = 0.5


class Numbers(NamedTuple):
    """Rate in 1/s."""

    rate: float


def numbers(params: Starter) -> Numbers:
    """Return what the compiled loop needs."""
    return Numbers(params.rate)


def braking(known: Numbers, acceleration: Vec, velocity: Vec) -> Vec:
    """Return what is added to the acceleration in m/s²."""
    return scale(-known.rate, velocity)


def step_share(params: Starter) -> float:
    """Return the share of the stable step that is left for an oscillator with the damping ratio."""
    return sqrt(1.0 + params.ratio * params.ratio) - params.ratio


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the damping."""
    registry.damping("starter", Damping("a drag in proportion to mass", Starter, Numbers, numbers, braking, step_share))
