"""Midstep: forces half-way through the step, with velocities predicted to the same instant."""

from __future__ import annotations

from math import sqrt

from clast import hookimpl
from clast.parts.integrator import Integrator, Stage
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Midstep(Params):
    r"""Position Verlet with a predicted mid-step velocity: second order with damping too.

    Equation
    --------
    x_m = x + ½ v Δt,  a = F(x_m, v + ½ a_prev Δt)/m,  v' = v + a Δt,  x' = x_m + ½ v' Δt

    Limits
    ------
    Stable below 2/ω (√(1 + 4ζ²) − 2ζ) for damping ratio ζ.

    Source
    ------
    Position Verlet (Tuckerman, Berne, Martyna 1992, doi:10.1063/1.463137) with a linear velocity predictor.
    """


def damping_factor(zeta: float) -> float:
    """Return the stable step with damping ratio ζ as a share of 2/ω.

    >>> damping_factor(0.0)
    1.0
    """
    return sqrt(1.0 + 4.0 * zeta * zeta) - 2.0 * zeta


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer midstep."""
    registry.integrator(
        "midstep",
        Integrator(
            summary="forces half-way through the step with predicted velocities, second order",
            Params=Midstep,
            stages=(Stage(kick_before=0.0, drift_before=0.5, predict=0.5, kick_after=1.0, drift_after=0.5),),
            damping_factor=damping_factor,
            order=2,
        ),
    )
