"""FIRE: all velocities are turned towards the forces, and stopped together where the way leads uphill."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number
from clast.maths.vec3 import Vec, add, scale
from clast.parts.damping import Damping, Together
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Fire(Params):
    r"""Lets the scene run downhill and stops it where it would climb: what is soft and large finds its rest soon.

    Equation
    --------
    P = Σ F · v + M · ω;  v ← (1 − α) v + α |v|/|a| a  where P > 0,  v ← 0  where not;  ω likewise, before each kick

    Symbols
    -------
    P : power of all forces on all particles together, in W
    v, a : velocity and acceleration of a particle, in m/s and m/s²; |v|/|a| is √(Σ m v² + I ω²)/√(Σ F²/m + M²/I)
    α : ``mixing`` at first; after P > 0 at ``delay`` evaluations of forces in a row, ``fading`` of it from each to the
        next

    Limits
    ------
    For finding rest, not for motion: time has no meaning, and neither momentum nor angular momentum is kept. Where the
    way decides which rest is found, with friction or bonds that break, another damping finds another one. Walls that
    forces move are not stopped with the particles. As published the scheme also lengthens the step, to ten times that
    of the dynamics; Clast's is a share of the stable limit from the start, and stays as it is. Its stable step is 1/√2
    of the one without. Integrators must evaluate forces once a step.

    Source
    ------
    E. Bitzek, P. Koskinen, F. Gähler, M. Moseler, P. Gumbsch (2006), Phys. Rev. Lett. 97, 170201,
    doi:10.1103/PhysRevLett.97.170201; the defaults are theirs.
    """

    mixing: Annotated[Number, Field(ge=0, le=1, description="Share α with which velocities turn towards forces")] = 0.1
    fading: Annotated[Number, Field(gt=0, le=1, description="What is left of α from one evaluation to the next")] = 0.99
    delay: Annotated[int, Field(ge=0, description="Evaluations with P > 0 after which α begins to fade")] = 5


class Numbers(NamedTuple):
    """Parameters."""

    mixing: float
    fading: float
    delay: float


class Steer(NamedTuple):
    """What the acceleration of every particle gets: so much of its velocity, in 1/s, and so much of itself."""

    of_velocity: float
    of_acceleration: float


def numbers(params: Fire) -> Numbers:
    """Return the numbers of the damping."""
    return Numbers(params.mixing, params.fading, float(params.delay))


def steering(known: Numbers, together: Together) -> Steer:
    """Return what is added to all accelerations, so that the step does what the scheme does to velocities.

    >>> steering(Numbers(0.1, 0.99, 5.0), Together(power=-1.0, motion=4.0, force=1.0, downhill=0, dt=0.5))
    Steer(of_velocity=-2.0, of_acceleration=0.0)
    """
    if not together.power > 0.0:
        return Steer(-1.0 / together.dt, 0.0)
    mixed = known.mixing * known.fading ** max(together.downhill - known.delay, 0.0)
    return Steer(-mixed / together.dt, mixed * sqrt(together.motion / together.force) / together.dt)


def braking(steer: Steer, acceleration: Vec, velocity: Vec) -> Vec:
    """Return what is added to the acceleration in m/s²."""
    return add(scale(steer.of_velocity, velocity), scale(steer.of_acceleration, acceleration))


def step_share(params: Fire) -> float:
    """Return the share of the stable step that is left.

    Stopped before every kick, an oscillator goes down the steepest way, x ← (1 − ω² Δt²) x: stable up to Δt = √2/ω.
    """
    return sqrt(0.5)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer FIRE."""
    registry.damping(
        "fire",
        Damping(
            summary="all velocities turned towards the forces, and stopped where the way leads uphill, to find rest",
            Params=Fire,
            Numbers=Numbers,
            numbers=numbers,
            braking=braking,
            step_share=step_share,
            steering=steering,
        ),
    )
