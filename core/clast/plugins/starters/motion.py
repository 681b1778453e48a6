"""Starter: a wall that goes to and fro."""

from __future__ import annotations

from math import cos, pi
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Time, VelocityVector
from clast.maths.vec3 import Vec, scale
from clast.parts.motion import Motion
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """Velocity that swings about zero.

    Equation
    --------
    v(t) = v_0 cos(2 π t/T)

    Source
    ------
    Plain kinematics.
    """

    velocity: Annotated[VelocityVector, Field(examples=[[0, 0, "1 m/s"]], description="Velocity at the start, v_0")]
    period: Annotated[Time, Field(gt=0, examples=["1 ms"], description="Period T")]


class Course(NamedTuple):
    """Velocity in m/s and angular frequency in rad/s."""

    velocity: Vec
    omega: float


def course(params: Starter) -> Course:
    """Return the numbers that the compiled loop needs."""
    return Course(params.velocity, 2.0 * pi / params.period)


def velocity(course: Course, time: float) -> Vec:
    """Return the velocity of the wall in m/s."""
    return scale(cos(course.omega * time), course.velocity)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the motion."""
    registry.motion("starter", Motion("to and fro", Starter, Course, course, velocity))
