"""A wall that turns about an axis: a drum, a mill, a stirrer."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import AngularVelocity, Direction, Point, Time
from clast.maths.vec3 import ZERO, Vec, norm, scale
from clast.parts.motion import Motion
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Rotation(Params):
    r"""Turns about a fixed axis, at a constant rate or after a start that speeds up evenly.

    Equation
    --------
    v(x) = ω × (x − p),  ω = Ω n min(t/T, 1)

    Symbols
    -------
    Ω : ``rate`` in rad/s, counter-clockwise seen against n; n : unit vector along ``axis``; p : ``point``
    T : ``speed_up`` in s; 0: the full rate from the start

    Limits
    ------
    The axis stays where it is. From one force evaluation to the next the rate is that of the middle, so angles are
    exact. Neighbours are searched again once the farthest place that particles may touch has come half a skin, with
    round shells too, whose surface does not change.

    Source
    ------
    Kinematics of a rigid body; orientations as particles have them.
    """

    axis: Annotated[Direction, Field(examples=[[0, 1, 0]], description="Direction of the axis")]
    rate: Annotated[AngularVelocity, Field(examples=["2 rad/s"], description="Angular velocity")]
    point: Annotated[Point, Field(description="A point of the axis, about which the moment is reported")] = ZERO
    speed_up: Annotated[Time, Field(ge=0, description="Time over which the rate grows from 0")] = 0.0


class Course(NamedTuple):
    """Angular velocity in rad/s, and the time in s from which on it is constant."""

    spin: Vec
    speed_up: float


def course(params: Rotation) -> Course:
    """Return the numbers of the motion."""
    return Course(scale(params.rate / norm(params.axis), params.axis), params.speed_up)


def velocity(course: Course, time: float) -> Vec:
    """Return the velocity of the axis: none."""
    return ZERO


def spin(course: Course, time: float) -> Vec:
    """Return the angular velocity in rad/s.

    >>> drum = Course((0.0, 4.0, 0.0), speed_up=2.0)
    >>> spin(drum, 0.5), spin(drum, 3.0)
    ((0.0, 1.0, 0.0), (0.0, 4.0, 0.0))
    """
    share = time / course.speed_up if time < course.speed_up else 1.0
    return scale(share, course.spin)


def pivot(params: Rotation) -> Vec:
    """Return the point about which the wall turns, in m."""
    return params.point


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the rotation."""
    registry.motion(
        "rotation",
        Motion(
            summary="turns about a fixed axis: drums, mills, stirrers",
            Params=Rotation,
            Course=Course,
            course=course,
            velocity=velocity,
            spin=spin,
            pivot=pivot,
        ),
    )
