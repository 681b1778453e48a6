"""A wall that moves with constant velocity."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import VelocityVector
from clast.maths.vec3 import Vec
from clast.parts.motion import Motion
from clast.parts.params import Params
from clast.plugins.registry import Registry


class ConstantVelocity(Params):
    """Translation with one velocity from start to end."""

    velocity: Annotated[VelocityVector, Field(examples=[[0, 0, "-10 mm/s"]], description="Velocity of the wall")]


class Course(NamedTuple):
    """Velocity in m/s."""

    velocity: Vec


def course(params: ConstantVelocity) -> Course:
    """Return the numbers of the motion."""
    return Course(params.velocity)


def velocity(course: Course, time: float) -> Vec:
    """Return the velocity in m/s."""
    return course.velocity


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer constant velocity."""
    registry.motion(
        "constant_velocity",
        Motion(
            summary="translation with one velocity",
            Params=ConstantVelocity,
            Course=Course,
            course=course,
            velocity=velocity,
        ),
    )
