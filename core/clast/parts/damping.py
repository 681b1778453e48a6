"""Damping: what brakes every particle by itself, beside the dashpots of contacts and bonds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from clast.maths.vec3 import Vec
from clast.parts.params import Params


def whole(params: Any) -> float:
    """Return 1, whatever the parameters: the share of the stable step that a damping leaves which costs nothing."""
    return 1.0


class Together(NamedTuple):
    """What all particles that forces can move do together, at an evaluation of forces.

    With mass and moment of inertia as they are in the step, scaled where mass is; sums over particles.

    Attributes
    ----------
    power : float
        Σ F · v + M · ω in W: above 0 where the motion goes the way the forces push.
    motion : float
        Σ m v² + I ω² in J.
    force : float
        Σ F²/m + M²/I in N²/kg.
    downhill : int
        At how many evaluations in a row, this one included, ``power`` was above 0.
    dt : float
        Time step in s.
    """

    power: float
    motion: float
    force: float
    downhill: int
    dt: float


@dataclass(frozen=True)
class Damping:
    """The part a plugin registers with ``registry.damping(name, Damping(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``damping``.
    Numbers : NamedTuple type
        The numbers the compiled loop needs.
    numbers : (params) -> Numbers
    braking : (numbers, acceleration, velocity) -> vector
        What the damping adds to the acceleration that all forces give a particle, in m/s², at its velocity in m/s; and
        to its angular acceleration in rad/s², at its spin in rad/s. Must not add energy: braking · velocity ≤ 0.
        With ``steering`` it gets the answer of that in place of the numbers, velocities before the kick, and the sum
        over all particles must not add energy.
    step_share : (params) -> float, optional
        Share of the stable step that the damping leaves, whatever the scene and the integrator.
    steering : (numbers, Together) -> record or vector, optional
        For dampings of all particles together: what ``braking`` is told at this evaluation of forces. It costs a sum
        over the scene in every step, and needs an integrator that evaluates forces once a step.
    """

    summary: str
    Params: type[Params]
    Numbers: type
    numbers: Callable[[Any], Any]
    braking: Callable[..., Vec]
    step_share: Callable[[Any], float] = whole
    steering: Callable[[Any, Together], Any] | None = None
