"""Velocity Verlet: half a kick before and after the forces."""

from __future__ import annotations

from math import sqrt

from clast import hookimpl
from clast.parts.integrator import Integrator, Stage
from clast.parts.params import Params
from clast.plugins.registry import Registry


class VelocityVerlet(Params):
    r"""Kick, drift, forces, kick; damping and friction see half-step velocities.

    Equation
    --------
    v_h = v + ½ a Δt,  x' = x + v_h Δt,  a' = F(x', v_h)/m,  v' = v_h + ½ a' Δt

    Limits
    ------
    First order in velocity-dependent forces. Stable below 2/ω (√(1 + ζ²) − ζ) for damping ratio ζ.

    Source
    ------
    Swope et al. (1982), doi:10.1063/1.442716.
    """


def damping_factor(zeta: float) -> float:
    """Return the stable step with damping ratio ζ as a share of 2/ω."""
    return sqrt(1.0 + zeta * zeta) - zeta


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer velocity Verlet."""
    registry.integrator(
        "velocity_verlet",
        Integrator(
            summary="kick, drift, forces, kick",
            Params=VelocityVerlet,
            stages=(Stage(kick_before=0.5, drift_before=1.0, predict=0.0, kick_after=0.5, drift_after=0.0),),
            damping_factor=damping_factor,
            order=2,
        ),
    )
