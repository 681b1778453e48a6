"""A wall that swings about an axis: the jaw of a crusher."""

from __future__ import annotations

from math import cos, pi
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Angle, Direction, Frequency, Number, Point
from clast.maths.vec3 import ZERO, Vec, norm, scale
from clast.parts.motion import Motion
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Swing(Params):
    r"""Swings about a fixed axis, with given amplitude and frequency.

    Equation
    --------
    angle = A (sin(2π f t + φ) − sin φ),  ω = 2π f A n cos(2π f t + φ)

    Symbols
    -------
    A : ``amplitude`` in rad, counter-clockwise seen against n; n : unit vector along ``axis``, through ``point``
    f : ``frequency`` in 1/s; φ : ``phase``, given as a share of a period

    Limits
    ------
    With phase 0 the wall starts in the middle, at its full rate; with three quarters from rest at the end from which it
    turns counter-clockwise. The axis stays where it is.

    Source
    ------
    Kinematics of a rigid body.
    """

    axis: Annotated[Direction, Field(examples=[[0, 1, 0]], description="Direction of the axis")]
    amplitude: Annotated[Angle, Field(gt=0, examples=["2 deg"], description="From the middle of the swing to its end")]
    frequency: Annotated[Frequency, Field(gt=0, examples=["5 Hz"], description="Swings a second")]
    point: Annotated[Point, Field(description="A point of the axis, about which the moment is reported")] = ZERO
    phase: Annotated[Number, Field(ge=0, lt=1, description="Where the swing begins, as a share of a period")] = 0.0


class Course(NamedTuple):
    """Largest angular velocity in rad/s, angular frequency in 1/s, and phase in rad."""

    spin: Vec
    angular: float
    phase: float


def course(params: Swing) -> Course:
    """Return the numbers of the motion."""
    angular = 2.0 * pi * params.frequency
    spin = scale(angular * params.amplitude / norm(params.axis), params.axis)
    return Course(spin, angular, 2.0 * pi * params.phase)


def velocity(course: Course, time: float) -> Vec:
    """Return the velocity of the axis: none."""
    return ZERO


def spin(course: Course, time: float) -> Vec:
    """Return the angular velocity in rad/s.

    >>> jaw = Course((0.0, 2.0, 0.0), angular=pi, phase=0.0)
    >>> spin(jaw, 0.0), spin(jaw, 1.0)
    ((0.0, 2.0, 0.0), (-0.0, -2.0, -0.0))
    """
    return scale(cos(course.angular * time + course.phase), course.spin)


def pivot(params: Swing) -> Vec:
    """Return the point about which the wall turns, in m."""
    return params.point


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the swing."""
    registry.motion(
        "swing",
        Motion(
            summary="swings about a fixed axis, such as the jaw of a crusher",
            Params=Swing,
            Course=Course,
            course=course,
            velocity=velocity,
            spin=spin,
            pivot=pivot,
        ),
    )
