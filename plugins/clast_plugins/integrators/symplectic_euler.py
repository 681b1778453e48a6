"""Symplectic Euler: one drift, one kick, positions and velocities told as of one time."""

from __future__ import annotations

from math import sqrt

from clast import hookimpl
from clast.parts.integrator import Integrator, Stage
from clast.parts.params import Params
from clast.plugins.registry import Registry


class SymplecticEuler(Params):
    r"""One drift with the velocity so far, then one kick: the simplest scheme that does not heat what swings.

    Equation
    --------
    x' = x + v Δt,  v' = v + F(x', v)/m Δt

    Symbols
    -------
    x, v, x', v' : positions and velocities before and after a step, in m and m/s; F : force in N; m : mass in kg

    Limits
    ------
    First order: v counts as the velocity at the time of x, while it is that of half a step later. Where nothing
    accelerates at the start, positions are of second order nevertheless. First order in velocity-dependent forces too.
    Stable below 2/ω (√(1 + ζ²) − ζ) for damping ratio ζ. The other order, kick then drift, moves particles to the bit
    as ``leapfrog`` does, which counts its velocities as those of half a step before; so this scheme is leapfrog
    started half a step off, and there is no reason to choose it but comparison with programs that use it.

    Source
    ------
    E. Hairer, C. Lubich, G. Wanner (2003), Acta Numerica 12, Section 1.2, doi:10.1017/S0962492902000144.
    """


def damping_factor(zeta: float) -> float:
    """Return the stable step with damping ratio ζ as a share of 2/ω."""
    return sqrt(1.0 + zeta * zeta) - zeta


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer symplectic Euler."""
    registry.integrator(
        "symplectic_euler",
        Integrator(
            summary="drift, forces, kick; first order, for comparison",
            Params=SymplecticEuler,
            stages=(Stage(kick_before=0.0, drift_before=1.0, predict=0.0, kick_after=1.0, drift_after=0.0),),
            damping_factor=damping_factor,
            order=1,
        ),
    )
