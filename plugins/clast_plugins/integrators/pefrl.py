"""PEFRL: a fourth-order scheme with four force evaluations a step, which contacts do not reward."""

from __future__ import annotations

from functools import partial

from clast import hookimpl
from clast.parts.integrator import Integrator, Stage, stable_share
from clast.parts.params import Params
from clast.plugins.registry import Registry

XI, LAMBDA, CHI = 0.1786178958448091, -0.2123418310626054, -0.06626458266981849
OUTER_KICK, MIDDLE_DRIFT = 0.5 * (1.0 - 2.0 * LAMBDA), 1.0 - 2.0 * (CHI + XI)

STAGES = (
    Stage(kick_before=0.0, drift_before=XI, predict=0.0, kick_after=OUTER_KICK, drift_after=0.0),
    Stage(kick_before=0.0, drift_before=CHI, predict=0.0, kick_after=LAMBDA, drift_after=0.0),
    Stage(kick_before=0.0, drift_before=MIDDLE_DRIFT, predict=0.0, kick_after=LAMBDA, drift_after=0.0),
    Stage(kick_before=0.0, drift_before=CHI, predict=0.0, kick_after=OUTER_KICK, drift_after=XI),
)


class Pefrl(Params):
    r"""Position-extended Forest–Ruth-like scheme: fourth order where forces are smooth functions of positions.

    Equation
    --------
    x += ξ v Δt;  v += (1 − 2λ)/2 a Δt;  x += χ v Δt;  v += λ a Δt;  x += (1 − 2(χ + ξ)) v Δt;  and back in the same way

    Symbols
    -------
    x, v, a : position in m, velocity in m/s, and acceleration F(x)/m in m/s² at the position reached
    ξ, λ, χ : 0.1786178958448091, −0.2123418310626054, −0.06626458266981849

    Limits
    ------
    Four force evaluations a step, two of the four kicks and two of the five drifts backwards. A contact begins with a
    kink of the force, which no scheme follows better than with order 2.5 (Hertz), 1.25 (Tsuji damping) or 1 (a linear
    dashpot), so over contacts the four evaluations buy nothing; with forces that depend on velocities it is of first
    order. Friction and breaking cannot be undone by a step backwards. No energy ledger. Stable below 1.495 · 2/ω
    without damping, 0.37 of that for each force evaluation.

    Source
    ------
    I. P. Omelyan, I. M. Mryglod, R. Folk (2002), Computer Physics Communications 146, 188–202, Eqs. 20–22,
    doi:10.1016/S0010-4655(02)00451-4.
    """


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer PEFRL."""
    registry.integrator(
        "pefrl",
        Integrator(
            summary="fourth order where forces are smooth, four force evaluations a step",
            Params=Pefrl,
            stages=STAGES,
            damping_factor=partial(stable_share, STAGES),
            order=4,
        ),
    )
