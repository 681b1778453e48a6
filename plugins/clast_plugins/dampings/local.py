"""Local non-viscous damping: a share of the force on each particle, against its velocity."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number
from clast.maths.vec3 import Vec
from clast.parts.damping import Damping
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Local(Params):
    r"""Brakes every component of a motion with a share of the force that acts on it: what swings comes to rest soon.

    Equation
    --------
    F_d = −α |F| sign(v),  M_d = −α |M| sign(ω),  for each component by itself

    Symbols
    -------
    F, M : force and moment on a particle, body forces included, in N and N m
    v, ω : its velocity and spin as forces see them, in m/s and rad/s; sign(0) = 0
    α : ``factor``; a vibration loses with every half of a period all but √((1 − α)/(1 + α)) of its amplitude

    Limits
    ------
    For finding rest, not for motion: what falls freely is braked too, with (1 − α) g. It depends on the axes of the
    coordinates, and neither momentum nor angular momentum is kept. A motion at constant velocity costs nothing. The
    stable step is 1/√(1 + α) of the one without. Beyond α = 0.8 it is not stable with predicted velocities.

    Source
    ------
    P. A. Cundall (1987), Distinct element models of rock and soil structure, in E. T. Brown (ed.), Analytical and
    Computational Methods in Engineering Rock Mechanics, ch. 4; α = 0.7 is the usual value.
    """

    factor: Annotated[Number, Field(gt=0, le=0.8, description="Share α of the force that brakes")] = 0.7


class Numbers(NamedTuple):
    """The share α."""

    factor: float


def numbers(params: Local) -> Numbers:
    """Return the numbers of the damping."""
    return Numbers(params.factor)


def against(factor: float, acceleration: float, velocity: float) -> float:
    """Return what one component of a motion is braked with.

    >>> against(0.5, -4.0, 1.0), against(0.5, -4.0, -1.0), against(0.5, -4.0, 0.0)
    (-2.0, 2.0, 0.0)
    """
    size = factor * abs(acceleration)
    return -size if velocity > 0.0 else (size if velocity < 0.0 else 0.0)


def braking(numbers: Numbers, acceleration: Vec, velocity: Vec) -> Vec:
    """Return what is added to the acceleration in m/s²."""
    a, v = acceleration, velocity
    return (
        against(numbers.factor, a[0], v[0]),
        against(numbers.factor, a[1], v[1]),
        against(numbers.factor, a[2], v[2]),
    )


def step_share(params: Local) -> float:
    """Return the share of the stable step that is left: moving away from rest, springs seem 1 + α times as stiff."""
    return 1.0 / sqrt(1.0 + params.factor)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer local damping."""
    registry.damping(
        "local",
        Damping(
            summary="a share of the force on each particle, against its velocity, to bring it to rest",
            Params=Local,
            Numbers=Numbers,
            numbers=numbers,
            braking=braking,
            step_share=step_share,
        ),
    )
