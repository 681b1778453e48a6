"""Leapfrog: velocities half a step behind positions."""

from __future__ import annotations

from math import sqrt
from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.parts.integrator import Integrator, Stage
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Leapfrog(Params):
    r"""Leapfrog with lagged velocities in damping and friction: the paper's scheme.

    Equation
    --------
    v' = v + F(x, v)/m Δt,  x' = x + v' Δt

    Limits
    ------
    First order in velocity-dependent forces. Stable below 2/ω (√(1 + ζ²) − ζ) for damping ratio ζ. Velocities in
    the results belong to half a step earlier than positions.

    Source
    ------
    Rotter, Dosta, Düster (2023), Section 2.
    """

    start_kick: Annotated[
        bool, Field(description="an extra half kick before the first step, as the authors' program makes")
    ] = False


def damping_factor(zeta: float) -> float:
    """Return the stable step with damping ratio ζ as a share of 2/ω."""
    return sqrt(1.0 + zeta * zeta) - zeta


def start_kick(params: Leapfrog) -> float:
    """Return the kick before the first step as a fraction of the step."""
    return 0.5 if params.start_kick else 0.0


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer leapfrog."""
    registry.integrator(
        "leapfrog",
        Integrator(
            summary="velocities half a step behind positions, the paper's scheme",
            Params=Leapfrog,
            stages=(Stage(kick_before=0.0, drift_before=0.0, predict=0.0, kick_after=1.0, drift_after=1.0),),
            damping_factor=damping_factor,
            order=2,
            start_kick=start_kick,
        ),
    )
