"""A wall with a mass that moves as the forces on it want."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import AccelerationVector, Direction, ForceVector, Mass, VelocityVector
from clast.maths.vec3 import ZERO, Vec, add, dot, norm, scale
from clast.parts.motion import Motion, Pressed, Pushed
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Free(Params):
    r"""A rigid body that particles push, gravity pulls and a force drives; it moves without turning: a lid, a piston.

    Equation
    --------
    M dv/dt = P + M g + F;  of the right-hand side only the part along a direction, where one is given

    Symbols
    -------
    M, v : mass of the wall in kg and its velocity in m/s
    P : force of the particles on it in N
    g, F : ``gravity`` in m/s² and ``force`` in N

    Limits
    ------
    Translation only; ``rigid_body`` turns. Other walls do not touch it. Between two force evaluations it keeps one
    velocity, as particles do: second order, and momentum is exchanged with particles without loss. Dashpots of contacts
    know its mass. The stable step is that with walls at rest and particles that are held as if they were not, times
    1/√(1 + Σm/M), m of all particles: safe for any M, and little less where the wall is heavy. The ledger counts the
    wall as outside: its own energy is not in it.

    Source
    ------
    Leapfrog, as particles have it: L. Verlet (1967), doi:10.1103/PhysRev.159.98.
    """

    mass: Annotated[Mass, Field(gt=1e-30, examples=["1 g"], description="Mass of the wall")]
    gravity: Annotated[
        AccelerationVector,
        Field(examples=[[0, 0, "-9.81 m/s2"]], description="Acceleration of gravity, for this wall alone"),
    ] = ZERO
    force: Annotated[ForceVector, Field(description="Constant force on the wall, besides")] = ZERO
    velocity: Annotated[VelocityVector, Field(description="Velocity at the start")] = ZERO
    along: Annotated[Direction | None, Field(description="Direction along which alone it moves; none: any")] = None


class Course(NamedTuple):
    """Mass in kg, acceleration of gravity and force in m/s², velocity at the start in m/s, unit direction or zero."""

    mass: float
    driven: Vec
    velocity: Vec
    along: Vec


def course(params: Free) -> Course:
    """Return the numbers of the motion."""
    along = ZERO if params.along is None else scale(1.0 / norm(params.along), params.along)
    driven = add(params.gravity, scale(1.0 / params.mass, params.force))
    return Course(params.mass, driven, held_to(along, params.velocity), along)


def held_to(along: Vec, vector: Vec) -> Vec:
    """Return the part of a vector along a unit direction; all of it where the direction is zero.

    >>> held_to((0.0, 0.0, 1.0), (1.0, 2.0, 3.0)), held_to((0.0, 0.0, 0.0), (1.0, 2.0, 3.0))
    ((0.0, 0.0, 3.0), (1.0, 2.0, 3.0))
    """
    if dot(along, along) == 0.0:
        return vector
    return scale(dot(along, vector), along)


def start(course: Course) -> Vec:
    """Return the velocity at the start in m/s."""
    return course.velocity


def answer(course: Course, time: float, pressed: Pressed) -> Vec:
    """Return the velocity in m/s: changed since the middle of the last span, to that of the next.

    >>> pushed = Pressed((0.0, 0.0, 4.0), mass=0.0, velocity=(0.0, 0.0, 1.0), span=0.5, since=0.5)
    >>> answer(Course(2.0, (0.0, 0.0, -1.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)), 0.0, pushed)
    (0.0, 0.0, 1.5)
    """
    acceleration = add(course.driven, scale(1.0 / course.mass, pressed.force))
    return held_to(course.along, add(pressed.velocity, scale(0.5 * (pressed.since + pressed.span), acceleration)))


def inverse_mass(course: Course, pushed: Pushed) -> float:
    """Return how a push along a normal moves the wall, in 1/kg.

    >>> inverse_mass(Course(2.0, ZERO, ZERO, (0.0, 0.0, 1.0)), Pushed((0.6, 0.0, 0.8), ZERO, (1.0, 0.0, 0.0, 0.0), 1.0))
    0.32000000000000006
    """
    moved = held_to(course.along, pushed.normal)
    return dot(moved, moved) / course.mass


def step_share(course: Course, mass: float, arm: float) -> float:
    """Return the share of the stable step that is left when particles of a mass in kg touch a wall that gives way."""
    return 1.0 / sqrt(1.0 + mass / course.mass)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the free wall."""
    registry.motion(
        "free",
        Motion(
            summary="a mass that moves as particles, gravity and a force want, without turning",
            Params=Free,
            Course=Course,
            course=course,
            start=start,
            answer=answer,
            inverse_mass=inverse_mass,
            step_share=step_share,
        ),
    )
