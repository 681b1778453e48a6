"""A wall whose velocity changes from one value to another, and stays."""

from __future__ import annotations

from typing import Annotated, Literal, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Time, VelocityVector
from clast.maths.vec3 import ZERO, Vec, add, scale
from clast.parts.motion import Motion
from clast.parts.params import Params
from clast.plugins.registry import Registry


class VelocityRamp(Params):
    r"""Velocity that rises or falls from one value to another, then stays; by default from rest.

    Equation
    --------
    v(t) = start + f(t/duration) (end − start);  f(s) = s (``linear``) or 3 s² − 2 s³ (``smooth``), and 1 from s = 1 on

    Notes
    -----
    ``smooth`` begins and ends without a jump of the acceleration. Either way the wall has moved by
    ½ duration (start + end) when the ramp is over.
    """

    start: Annotated[VelocityVector, Field(description="Velocity at the start")] = ZERO
    end: Annotated[
        VelocityVector, Field(examples=[[0, 0, "-10 mm/s"]], description="Velocity from the end of the ramp on")
    ]
    duration: Annotated[Time, Field(gt=0, examples=["1 ms"], description="How long the velocity changes")]
    shape: Annotated[Literal["smooth", "linear"], Field(description="how the velocity changes meanwhile")] = "smooth"


class Course(NamedTuple):
    """Velocities in m/s, duration in s, and 1 where the ramp is smooth, 0 where it is linear."""

    start: Vec
    end: Vec
    duration: float
    smooth: float


def course(params: VelocityRamp) -> Course:
    """Return the numbers of the motion."""
    return Course(params.start, params.end, params.duration, 1.0 if params.shape == "smooth" else 0.0)


def velocity(course: Course, time: float) -> Vec:
    """Return the velocity in m/s.

    >>> ramp = Course((0.0, 0.0, 0.0), (0.0, 0.0, -2.0), duration=4.0, smooth=1.0)
    >>> velocity(ramp, 1.0), velocity(ramp, 9.0)
    ((0.0, 0.0, -0.3125), (0.0, 0.0, -2.0))
    """
    s = min(max(time / course.duration, 0.0), 1.0)
    share = s * s * (3.0 - 2.0 * s) if course.smooth > 0.0 else s
    return add(scale(1.0 - share, course.start), scale(share, course.end))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the ramp."""
    registry.motion(
        "velocity_ramp",
        Motion(
            summary="velocity that changes from one value to another, then stays",
            Params=VelocityRamp,
            Course=Course,
            course=course,
            velocity=velocity,
        ),
    )
