"""Starter: position Verlet."""

from __future__ import annotations

from math import sqrt

from clast import hookimpl
from clast.parts.integrator import Integrator, Stage
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """Drift, forces, kick, drift.

    Equation
    --------
    x' = x + v Δt/2,  v' = v + F(x', v)/m Δt,  x'' = x' + v' Δt/2

    Limits
    ------
    First order where forces depend on velocities. Stable below 2/ω (√(1 + ζ²) − ζ) for the damping ratio ζ.

    Source
    ------
    Tuckerman, Berne and Martyna (1992), doi:10.1063/1.463137, as position Verlet.
    """


def damping_factor(zeta: float) -> float:
    """Return the stable step with damping ratio ζ as a share of 2/ω."""
    return sqrt(1.0 + zeta * zeta) - zeta


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the integrator."""
    registry.integrator(
        "starter",
        Integrator(
            summary="drift, forces, kick, drift",
            Params=Starter,
            stages=(Stage(kick_before=0.0, drift_before=0.5, predict=0.0, kick_after=1.0, drift_after=0.5),),
            damping_factor=damping_factor,
            order=2,
        ),
    )
