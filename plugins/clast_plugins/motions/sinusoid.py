"""A wall that swings to and fro."""

from __future__ import annotations

from math import cos, pi
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Frequency, Number, Point
from clast.maths.vec3 import Vec, scale
from clast.parts.motion import Motion
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Sinusoid(Params):
    r"""A swing of given amplitude and frequency, such as that of a shaker or a sieve.

    Equation
    --------
    displacement = A (sin(ω t + φ) − sin φ),  v = A ω cos(ω t + φ),  ω = 2π f

    Symbols
    -------
    A : ``amplitude`` in m, a vector along the swing; f : ``frequency`` in 1/s
    φ : ``phase``, given as a share of a period

    Limits
    ------
    With phase 0 the wall starts with its full speed A ω, with a quarter it starts from rest at one end. Two swings at
    right angles need two walls.
    """

    amplitude: Annotated[
        Point, Field(examples=[[0, 0, "0.1 mm"]], description="From the middle of the swing to its end")
    ]
    frequency: Annotated[Frequency, Field(gt=0, examples=["50 Hz"], description="Swings a second")]
    phase: Annotated[Number, Field(ge=0, lt=1, description="Where the swing begins, as a share of a period")] = 0.0


class Course(NamedTuple):
    """Largest velocity in m/s, angular frequency in 1/s, and phase in rad."""

    velocity: Vec
    angular: float
    phase: float


def course(params: Sinusoid) -> Course:
    """Return the numbers of the motion."""
    angular = 2.0 * pi * params.frequency
    return Course(scale(angular, params.amplitude), angular, 2.0 * pi * params.phase)


def velocity(course: Course, time: float) -> Vec:
    """Return the velocity in m/s.

    >>> swing = Course((0.0, 0.0, 2.0), angular=pi, phase=0.0)
    >>> velocity(swing, 0.0), velocity(swing, 1.0)
    ((0.0, 0.0, 2.0), (-0.0, -0.0, -2.0))
    """
    return scale(cos(course.angular * time + course.phase), course.velocity)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the swing."""
    registry.motion(
        "sinusoid",
        Motion(
            summary="swings with an amplitude and a frequency",
            Params=Sinusoid,
            Course=Course,
            course=course,
            velocity=velocity,
        ),
    )
