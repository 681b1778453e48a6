"""A wall that moves and turns as a rigid body, as the forces and moments on it want."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.quantities import (
    AccelerationVector,
    Direction,
    ForceVector,
    Mass,
    MomentVector,
    Point,
    PrincipalMoments,
    SpinVector,
    VelocityVector,
)
from clast.maths.rotation import Quat, matrix, rotate, rotate_back, turn
from clast.maths.vec3 import ZERO, Vec, add, cross, dot, norm, scale, sub
from clast.parts.motion import Motion, Pressed, Pushed, Turned
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.motions.free import held_to

ROUNDS = 40
"""How often, at the most, the spin in the middle of a span is found from the orientation there, which it leads to: each
time the error shrinks by the turn of half a step, in a slender body by more of it."""
LEAST_INERTIA = 1e-60
"""Moment of inertia in kg m² that no body falls short of."""
SETTLED = 1e-30
"""Square of the change, as a share, at which it is found."""


class RigidBody(Params):
    r"""A rigid body that particles push and turn, gravity pulls, and a force and a moment drive.

    Equation
    --------
    M dv/dt = P + M g + F;  dL/dt = T + N, L = R I Rᵀ ω;  of the right-hand sides only the part along a direction and
    about an axis, where one is given

    Symbols
    -------
    M, v : mass in kg and velocity of the centre of mass in m/s
    L, ω : angular momentum about it in kg m²/s, and angular velocity in rad/s
    I : moments of ``inertia`` in kg m², about the axes x, y, z as the body stands at the start; R : its rotation since
    P, T : force of the particles in N, and their moment about the centre of mass in N m
    g, F, N : ``gravity`` in m/s², ``force`` in N and ``moment`` in N m

    Limits
    ------
    The body's principal axes are those of the scene at the start: turn the shape so that they are. A shape that ends is
    needed, and other walls do not touch it. Momentum and, about a fixed point, angular momentum are exchanged with
    particles without loss but rounding, with turns up to 0.1 rad a step; beyond 0.5 rad a run ends. The energy of a
    body that tumbles swings to second order in its turn a step. Dashpots of contacts know how it gives way where it is
    pushed. The stable step is that with walls at rest and particles that are held as if they were not, times
    1/√(1 + Σm (1/M + a²/I_min)), m of all particles, a the farthest place of the surface: safe for any M and I. The
    ledger counts the body as outside: its own energy is not in it.

    Source
    ------
    Leapfrog of angular momenta: D. Fincham (1992), doi:10.1080/08927029208022474; M. P. Allen, D. J. Tildesley,
    "Computer Simulation of Liquids" (2nd ed., 2017), Section 3.3.1.
    """

    mass: Annotated[Mass, Field(gt=1e-30, examples=["1 g"], description="Mass of the body")]
    centre: Annotated[Point, Field(examples=[[0, 0, "5 mm"]], description="Its centre of mass, at the start")]
    inertia: Annotated[
        PrincipalMoments,
        Field(
            examples=[["4e-9 kg m2", "4e-9 kg m2", "4e-9 kg m2"]],
            description="Moments of inertia about axes along x, y and z through it",
        ),
    ]
    gravity: Annotated[
        AccelerationVector,
        Field(examples=[[0, 0, "-9.81 m/s2"]], description="Acceleration of gravity, for this body alone"),
    ] = ZERO
    force: Annotated[ForceVector, Field(description="Constant force on the body, besides")] = ZERO
    moment: Annotated[MomentVector, Field(description="Constant moment on the body, besides")] = ZERO
    velocity: Annotated[VelocityVector, Field(description="Velocity at the start")] = ZERO
    spin: Annotated[SpinVector, Field(description="Angular velocity at the start")] = ZERO
    along: Annotated[Direction | None, Field(description="Direction along which alone it moves; none: any")] = None
    about: Annotated[Direction | None, Field(description="Axis about which alone it turns; none: any")] = None

    @model_validator(mode="after")
    def _of_a_body(self) -> RigidBody:
        least, middle, most = sorted(self.inertia)
        if least <= LEAST_INERTIA or most > (least + middle) * (1.0 + 1e-9):
            raise ValueError(
                "inertia: no body has these three moments; all are above 0, and none is larger than the sum of the "
                "others"
            )
        return self


class Course(NamedTuple):
    """Mass in kg, moments of inertia in kg m² and what drives them, in m/s² and N m; speeds at the start; directions.

    ``along`` and ``about`` are unit vectors, or zero where any direction will do.
    """

    mass: float
    inertia: Vec
    driven: Vec
    moment: Vec
    velocity: Vec
    spin: Vec
    along: Vec
    about: Vec


def course(params: RigidBody) -> Course:
    """Return the numbers of the motion."""
    along, about = unit(params.along), unit(params.about)
    driven = add(params.gravity, scale(1.0 / params.mass, params.force))
    velocity, spin = held_to(along, params.velocity), held_to(about, params.spin)
    return Course(params.mass, params.inertia, driven, params.moment, velocity, spin, along, about)


def unit(direction: Vec | None) -> Vec:
    """Return the unit vector of a direction; zero for none."""
    return ZERO if direction is None else scale(1.0 / norm(direction), direction)


def momentum(inertia: Vec, q: Quat, spin: Vec) -> Vec:
    """Return the angular momentum of a body that is turned by q, in kg m²/s.

    >>> momentum((1.0, 2.0, 3.0), (1.0, 0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    (1.0, 2.0, 3.0)
    """
    R = matrix(q)
    w = rotate_back(R, spin)
    return rotate(R, (inertia[0] * w[0], inertia[1] * w[1], inertia[2] * w[2]))


def spin_of(inertia: Vec, q: Quat, momentum: Vec) -> Vec:
    """Return the angular velocity of such a body in rad/s."""
    R = matrix(q)
    L = rotate_back(R, momentum)
    return rotate(R, (L[0] / inertia[0], L[1] / inertia[1], L[2] / inertia[2]))


def start(course: Course) -> Vec:
    """Return the velocity at the start in m/s."""
    return course.velocity


def start_spin(course: Course) -> Vec:
    """Return the angular velocity at the start in rad/s."""
    return course.spin


def answer(course: Course, time: float, pressed: Pressed) -> Vec:
    """Return the velocity in m/s: changed since the middle of the last span, to that of the next."""
    acceleration = add(course.driven, scale(1.0 / course.mass, pressed.force))
    return held_to(course.along, add(pressed.velocity, scale(0.5 * (pressed.since + pressed.span), acceleration)))


def answer_spin(course: Course, time: float, turned: Turned) -> Vec:
    """Return the angular velocity in rad/s, in the middle of the next span.

    The angular momentum in the middle of the last span is that of the spin there, as the body was turned there. The
    moment changes it, and the body turns on to the middle of the next with the spin that it has there.

    >>> top = Course(1.0, (2.0, 2.0, 2.0), ZERO, ZERO, ZERO, ZERO, ZERO, ZERO)
    >>> answer_spin(top, 0.0, Turned((0.0, 0.0, 4.0), (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0), span=0.1, since=0.1))
    (0.0, 0.0, 1.2)
    """
    q, pushed = turned.orientation, add(course.moment, turned.moment)
    if dot(course.about, course.about) > 0.0:
        about = momentum(course.inertia, q, course.about)
        gain = 0.5 * (turned.since + turned.span) * dot(course.about, pushed) / dot(course.about, about)
        return add(held_to(course.about, turned.spin), scale(gain, course.about))
    before = momentum(course.inertia, turn(q, turned.spin, -0.5 * turned.since), turned.spin)
    after = add(before, scale(0.5 * (turned.since + turned.span), pushed))
    spin = turned.spin
    for _ in range(ROUNDS):
        last, spin = spin, spin_of(course.inertia, turn(q, spin, 0.5 * turned.span), after)
        change = sub(spin, last)
        if dot(change, change) <= SETTLED * dot(spin, spin):
            break
    return spin


def inverse_mass(course: Course, pushed: Pushed) -> float:
    """Return how a push along a normal moves the place that is pushed along it, in 1/kg: it moves and turns the body.

    >>> rod = Course(2.0, (1.0, 1.0, 1.0), ZERO, ZERO, ZERO, ZERO, ZERO, ZERO)
    >>> inverse_mass(rod, Pushed((0.0, 0.0, 1.0), (3.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0), 1.0))
    9.5
    """
    moved, lever = held_to(course.along, pushed.normal), cross(pushed.arm, pushed.normal)
    turned = spin_of(course.inertia, pushed.orientation, lever)
    if dot(course.about, course.about) > 0.0:
        about = momentum(course.inertia, pushed.orientation, course.about)
        turned = scale(dot(course.about, lever) / dot(course.about, about), course.about)
    return dot(moved, moved) / course.mass + dot(lever, turned)


def step_share(course: Course, mass: float, arm: float) -> float:
    """Return the share of the stable step that is left when particles of a mass in kg touch a body that gives way."""
    return 1.0 / sqrt(1.0 + mass * (1.0 / course.mass + arm * arm / min(course.inertia)))


def pivot(params: RigidBody) -> Vec:
    """Return the centre of mass at the start, in m."""
    return params.centre


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the rigid body."""
    registry.motion(
        "rigid_body",
        Motion(
            summary="a body with mass and moments of inertia that moves and turns as forces and moments want",
            Params=RigidBody,
            Course=Course,
            course=course,
            start=start,
            answer=answer,
            inverse_mass=inverse_mass,
            start_spin=start_spin,
            answer_spin=answer_spin,
            pivot=pivot,
            step_share=step_share,
        ),
    )
