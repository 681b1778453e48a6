"""A wall that presses with a given force."""

from __future__ import annotations

from math import pi
from typing import Annotated, NamedTuple

from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.problems import wrong
from clast.config.quantities import Direction, Force, Length, Stress, Time, Velocity
from clast.maths.vec3 import Vec, dot, norm, scale
from clast.parts.motion import Motion, Pressed, Pushed
from clast.parts.params import Params
from clast.plugins.registry import Registry

INERTIA = 10.0
"""Mass of the wall as a share of the mass of all particles: together they vibrate at most √(1 + 1/10) = 1.05 times as
fast as the particles do at a wall that stands still."""


class ForceControl(Params):
    r"""A wall that moves along a direction so that it presses with a given force, or with a given stress on a disc.

    It comes from afar with ``max_velocity`` and is never faster; where the particles press back harder than they
    should, it gives way.

    Equation
    --------
    M dv/dt = F(t) − P − v F_end/v_max,  |v| ≤ v_max;  as M counts for little, v ≈ v_max (F(t) − P)/F_end

    Symbols
    -------
    v, v_max : velocity along the direction and ``max_velocity`` in m/s
    P : force of the particles against the direction in N
    F(t), F_end : force to press with now and at last in N; F rises from 0 to F_end within ``ramp``
    M : 10 times the mass of all particles of the scene in kg

    Why it is stable
    ----------------
    The wall is a piston with a dashpot, pushed by F: it takes energy out of every deviation and gives none, so with
    any fill that gives none, soft, stiff, breaking or ringing, it cannot build up vibrations. In steps of time: the
    dashpot is taken implicitly, and a wall that is free to move and 10 times as heavy as what touches it raises the
    fastest vibration by 5 % at most. A step of up to 0.95 of the limit at walls that stand still is stable, whatever
    force and velocity are asked for.

    Limits
    ------
    While a fill gives way with the velocity u, P stays below F by the share u/v_max. A fill of the stiffness K follows
    with the time F_end/(v_max K); from rest the wall takes the time M v_max/F_end to come to speed. Where 2 √(K M)
    exceeds F_end/v_max, as when v_max means an impact, P rings before it settles: take a smaller ``max_velocity``.
    When the last particle is gone the wall moves on with v_max. The force is held at every force evaluation, not as a
    mean over some time.

    Source
    ------
    Velocity in proportion to the error of the force: the servo of Itasca's PFC, whose gain α/(K Δt) follows the
    stiffness of the contacts and the time step; here it depends on neither. Stability at every passive environment:
    Colgate and Hogan (1988), doi:10.1080/00207178808906161.
    """

    direction: Annotated[Direction, Field(examples=[[0, 0, -1]], description="Direction in which the wall presses")]
    force: Annotated[
        Annotated[Force, Field(gt=0)] | None, Field(examples=["1 N"], description="Force to press with")
    ] = None
    stress: Annotated[
        Annotated[Stress, Field(gt=0)] | None, Field(description="Stress to press with, instead of the force")
    ] = None
    diameter: Annotated[
        Annotated[Length, Field(gt=0)] | None, Field(description="Diameter of the disc that the stress refers to")
    ] = None
    max_velocity: Annotated[
        Velocity, Field(gt=0, examples=["10 mm/s"], description="Largest speed, and that of the approach")
    ]
    ramp: Annotated[Time, Field(ge=0, description="Time from the start in which the force rises from 0")] = 0.0

    @model_validator(mode="after")
    def _one_load(self) -> ForceControl:
        if (self.force is None) == (self.stress is None):
            text = "exactly one of force and stress is needed; given "
            raise wrong("stress", f"{text}both") if self.force is not None else ValueError(f"{text}neither")
        if (self.stress is None) != (self.diameter is None):
            key = "stress" if self.diameter is None else "diameter"
            text = "a stress needs a diameter" if self.diameter is None else "a diameter needs a stress, not a force"
            raise wrong(key, f"{text}: the force is the stress times the area of that disc")
        return self


class Course(NamedTuple):
    """Unit direction, force at last in N, largest speed in m/s, and the time in s in which the force rises."""

    direction: Vec
    force: float
    max_velocity: float
    ramp: float


def course(params: ForceControl) -> Course:
    """Return the numbers of the motion."""
    direction = scale(1.0 / norm(params.direction), params.direction)
    force = params.force
    if force is None:
        assert params.stress is not None
        assert params.diameter is not None
        force = 0.25 * pi * params.diameter**2 * params.stress
    return Course(direction, force, params.max_velocity, params.ramp)


def force_now(course: Course, time: float) -> float:
    """Return the force to press with at a time in N.

    >>> force_now(Course((0.0, 0.0, -1.0), force=8.0, max_velocity=0.1, ramp=4.0), time=1.0)
    2.0
    """
    return course.force if time >= course.ramp else course.force * time / course.ramp


def answer(course: Course, time: float, pressed: Pressed) -> Vec:
    """Return the velocity in m/s: a step of the equation of motion, with its dashpot taken implicitly.

    >>> free = Pressed(force=(0.0, 0.0, 0.0), mass=0.0, velocity=(0.0, 0.0, 0.0), span=1e-6)
    >>> answer(Course((0.0, 0.0, -1.0), force=8.0, max_velocity=0.1, ramp=0.0), 0.0, free)
    (0.0, 0.0, -0.1)
    """
    lacking = force_now(course, time) + dot(pressed.force, course.direction)
    inertia = INERTIA * pressed.mass / pressed.span
    dashpot = course.force / course.max_velocity
    speed = (lacking + inertia * dot(pressed.velocity, course.direction)) / (dashpot + inertia)
    return scale(min(max(speed, -course.max_velocity), course.max_velocity), course.direction)


def inverse_mass(course: Course, pushed: Pushed) -> float:
    """Return how a push along a normal moves the wall, in 1/kg, but for its dashpot.

    >>> up = Pushed((0.0, 0.0, 1.0), arm=(0.0, 0.0, 0.0), orientation=(1.0, 0.0, 0.0, 0.0), mass=0.2)
    >>> inverse_mass(Course((0.0, 0.0, -1.0), force=8.0, max_velocity=0.1, ramp=0.0), up)
    0.5
    """
    along = dot(course.direction, pushed.normal)
    return along * along / (INERTIA * pushed.mass)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer force control."""
    registry.motion(
        "force_control",
        Motion(
            summary="presses with a given force or stress, never faster than a given velocity",
            Params=ForceControl,
            Course=Course,
            course=course,
            answer=answer,
            inverse_mass=inverse_mass,
        ),
    )
