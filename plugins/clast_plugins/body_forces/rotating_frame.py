"""A frame that turns: the forces that particles in a centrifuge or a drum feel."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Point, SpinVector
from clast.maths.vec3 import ZERO, Vec, add, cross, scale, sub
from clast.parts.body_force import BodyForce
from clast.parts.params import Params
from clast.plugins.registry import Registry


class RotatingFrame(Params):
    r"""Centrifugal and Coriolis acceleration of a frame that turns about an axis at a constant rate.

    Equation
    --------
    a = −Ω x (Ω x (x − p)) − 2 Ω x v

    Symbols
    -------
    Ω : ``spin`` of the frame in rad/s; p : ``point`` of the axis in m; x, v : position and velocity seen in the frame

    Limits
    ------
    The rate is constant: there is no Euler force. Spins of particles are those against the frame, and are not changed
    by it: what spins freely would seem to precess. Mass scaling divides it, so that weights stay what they are.

    Source
    ------
    L. D. Landau, E. M. Lifshitz (1976), Mechanics, 3rd ed., § 39.
    """

    spin: Annotated[SpinVector, Field(examples=[[0, 0, "100 rad/s"]], description="Angular velocity of the frame")]
    point: Annotated[Point, Field(description="A point of the axis")] = ZERO


class Numbers(NamedTuple):
    """Angular velocity in rad/s, a point of the axis in m, and what accelerations are divided by."""

    spin: Vec
    point: Vec
    per_mass: float


def numbers(params: RotatingFrame, mass_scaling: float) -> Numbers:
    """Return the numbers of the frame."""
    return Numbers(params.spin, params.point, 1.0 / mass_scaling)


def acceleration(numbers: Numbers, x: Vec, v: Vec, time: float) -> Vec:
    """Return the acceleration in m/s².

    >>> acceleration(Numbers((0.0, 0.0, 2.0), (0.0, 0.0, 0.0), 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), 0.0)
    (8.0, -0.0, -0.0)
    """
    turned = cross(numbers.spin, sub(x, numbers.point))
    return scale(-numbers.per_mass, add(cross(numbers.spin, turned), scale(2.0, cross(numbers.spin, v))))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the rotating frame."""
    registry.body_force(
        "rotating_frame",
        BodyForce(
            summary="centrifugal and Coriolis acceleration of a frame that turns",
            Params=RotatingFrame,
            Numbers=Numbers,
            numbers=numbers,
            acceleration=acceleration,
        ),
    )
