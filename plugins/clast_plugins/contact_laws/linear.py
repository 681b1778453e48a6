"""Linear spring and dashpot with Coulomb sliding."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number, Unit
from clast.maths.vec3 import ZERO, dot, scale, sub
from clast.parts.contact_law import ContactLaw, ContactLoad, ContactLosses, Drag, Features, MaterialPair, Touch
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.contact_laws.damping import damping_ratio
from clast_plugins.contact_laws.friction import (
    LIMITS,
    Choices,
    CoulombLimit,
    History,
    TensionCutoff,
    damped,
    frictional_losses,
    limiting_force,
    sliding,
)


class Linear(Params):
    r"""Springs of constant stiffness with dashpots, and Coulomb sliding.

    Equation
    --------
    F_n = k_n δ + 2 β √(m* k_n) v_n
    F_t = k_t ξ + 2 β √(m* k_t) v_t,  k_t = κ k_n,  |F_t| ≤ μ F_lim

    Symbols
    -------
    δ, v_n : overlap in m and its rate in m/s
    ξ, v_t : tangential displacement since touch in m and its rate, as in ``hertz_mindlin``
    k_n, κ : normal stiffness in N/m, required; ratio of the tangential to it
    m*, R* : effective mass and radius
    β : −ln e/√(π² + ln² e), at most 1: the damping ratio that rebounds with e, exactly
    F_lim : k_n δ (``elastic``), or the positive part of F_n (``total``)

    An impact lasts π √(m*/k_n)/√(1 − β²), whatever its speed. The default κ = 2/7 gives the contact point of a sphere
    that sticks the same period across as along the normal.

    Options
    -------
    ``tension_cutoff: true`` never lets F_n pull; the coefficient of restitution is then not e but larger.

    Limits
    ------
    The stiffness is a number of the law, not of the materials, and the same for small and large spheres: choose it for
    overlaps below a hundredth of the radius. No adhesion.

    Source
    ------
    Cundall and Strack (1979), doi:10.1680/geot.1979.29.1.47; Schäfer, Dippel and Wolf (1996), doi:10.1051/jp1:1996129.
    """

    normal_stiffness: Annotated[
        float, Unit("N/m"), Field(gt=0, description="normal stiffness k_n", examples=["100 kN/m"])
    ]
    stiffness_ratio: Annotated[Number, Field(gt=0, description="tangential stiffness over normal stiffness, κ")] = (
        2.0 / 7.0
    )
    coulomb_limit: CoulombLimit = "elastic"
    tension_cutoff: TensionCutoff = False


class Constants(NamedTuple):
    """Numbers of one pair of materials; ``c_n`` and ``c_t`` are 2 β √k of both directions."""

    k_n: float
    k_t: float
    c_n: float
    c_t: float
    mu: float


def constants(params: Linear, pair: MaterialPair) -> Constants:
    """Compute the damping of a pair of materials."""
    k_n, k_t = params.normal_stiffness, params.stiffness_ratio * params.normal_stiffness
    c = 2.0 * damping_ratio(pair.restitution)
    return Constants(k_n, k_t, c * sqrt(k_n), c * sqrt(k_t), pair.sliding_friction)


def choices(params: Linear, features: Features) -> Choices:
    """Return what must be compiled."""
    return Choices(features.damping, features.sliding, LIMITS[params.coulomb_limit], params.tension_cutoff)


def load(touch: Touch, c: Constants, history: History, dt: float, chosen: Choices) -> tuple[ContactLoad, History]:
    """Return what the contact does to body j, and its new history."""
    elastic, root = c.k_n * touch.overlap, sqrt(1.0 / touch.inverse_mass) if chosen.damping else 0.0
    F_n = damped(elastic, c.c_n * root, touch, chosen)
    F_lim = limiting_force(elastic, F_n, chosen)
    F_t, xi = ZERO, history.xi
    if chosen.sliding:
        F_t, xi = sliding(touch, c.k_t, c.c_t * root, c.mu * F_lim, history.xi, dt, chosen)
    return ContactLoad(sub(scale(F_n, touch.normal), F_t), ZERO, ZERO, F_lim), History(xi)


def energy(touch: Touch, c: Constants, history: History, chosen: Choices) -> float:
    """Return ½ k_n δ² + ½ k_t ξ² in J."""
    stored = 0.5 * c.k_n * touch.overlap * touch.overlap
    if chosen.sliding:
        stored = stored + 0.5 * c.k_t * dot(history.xi, history.xi)
    return stored


def losses(
    touch: Touch,
    c: Constants,
    before: History,
    load: ContactLoad,
    after: History,
    dt: float,
    chosen: Choices,
    before_drag: Drag,
) -> ContactLosses:
    """Return what the contact has taken up since the forces before; no stiffness changes."""
    elastic = c.k_n * touch.overlap
    return frictional_losses(touch, elastic, c.k_t, c.k_t, before.xi, load, after.xi, chosen, before_drag)


def stiffness(c: Constants, radius: float, overlap: float) -> float:
    """Return k_n in N/m."""
    return c.k_n


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the linear law."""
    registry.contact_law(
        "linear",
        ContactLaw(
            summary="springs of constant stiffness with dashpots, Coulomb sliding",
            Params=Linear,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            energy=energy,
            stiffness=stiffness,
            History=History,
            losses=losses,
            limits_rolling=True,
        ),
    )
