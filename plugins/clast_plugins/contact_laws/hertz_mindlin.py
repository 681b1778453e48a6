"""Hertz–Mindlin contact with viscous damping and sliding friction."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, Literal, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.maths.vec3 import ZERO, scale, sub
from clast.parts.contact_law import ContactLaw, ContactLoad, Features, MaterialPair, Touch
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.contact_laws.damping import damping_ratio
from clast_plugins.contact_laws.friction import (
    LIMITS,
    Choices,
    History,
    TensionCutoff,
    damped,
    easing,
    limiting_force,
    sliding,
)
from clast_plugins.contact_laws.hertz import (
    contact_radius,
    elastic_force,
    energy,
    losses,
    stiffness,
    tangential_stiffness,
    tangential_stiffness_before,
)
from clast_plugins.contact_laws.moduli import normal_modulus, tangential_modulus


class HertzMindlin(Params):
    r"""Elastic spheres with Tsuji damping, and Coulomb sliding.

    Equation
    --------
    F_n = 4/3 E* √(R* δ) δ + c √(m* k_n) v_n,  k_n = 2 E* √(R* δ)
    F_t = k_t ξ + c √(m* k_t) v_t,  k_t = 8 G* √(R* δ),  |F_t| ≤ μ F_lim

    Symbols
    -------
    δ, v_n : overlap in m and its rate in m/s
    ξ, v_t : tangential displacement since touch in m and its rate; ξ turns with the contact plane. While the contact
        slides, spring and dashpot together give way in front of a slider: k_t ξ + c √(m* k_t) dξ/dt is the limit
    E*, G*, R*, m* : effective moduli, radius and mass
    c : 2 √(5/6) β, β = −ln e/√(π² + ln² e), at most 1
    F_lim : elastic part of F_n (``elastic``: the viscous part integrates to zero over an impact, so gross sliding
        gives the impulse μ (1 + e) m v_n), or its positive total (``total``)

    Options
    -------
    ``coulomb_limit: musen`` limits the elastic part of F_t alone by the unclipped |F_n| and drops its damping while
    sliding, as the paper's authors' program does: for comparison only.
    ``tension_cutoff: true`` never lets F_n pull; the coefficient of restitution is then not e but larger.
    ``tangential_memory: displacement`` takes k_t ξ at the present overlap: pressing a stretched contact harder tightens
    its spring, which creates energy. ``force`` adds k_t dξ to a force that stays as k_t grows and is scaled by
    k_t,new/k_t,old as it falls: either way the spring loses energy.

    Limits
    ------
    Small overlaps; no adhesion. A cylinder wall counts as flat.

    Source
    ------
    Hertz (1882); Mindlin and Deresiewicz (1953); Tsuji, Tanaka and Ishida (1992), doi:10.1016/0032-5910(92)88030-L;
    energy of the tangential spring: Elata and
    Berryman (1996), Mechanics of Materials 24, 229–240; Thornton, Cummins and Cleary (2013),
    doi:10.1016/j.powtec.2012.08.012.
    """

    coulomb_limit: Annotated[
        Literal["elastic", "total", "musen"],
        Field(description="the normal force that limits sliding and rolling"),
    ] = "elastic"
    tension_cutoff: TensionCutoff = False
    tangential_memory: Annotated[
        Literal["displacement", "force"], Field(description="what a stretched contact keeps while it is pressed harder")
    ] = "displacement"


class Constants(NamedTuple):
    """Numbers of one pair of materials; ``c_n`` and ``c_t`` are c √(2 E*) and c √(8 G*)."""

    E: float
    G: float
    c_n: float
    c_t: float
    mu: float


def constants(params: HertzMindlin, pair: MaterialPair) -> Constants:
    """Compute effective moduli and damping of a pair of materials."""
    E, G = normal_modulus(pair), tangential_modulus(pair)
    c = 2.0 * sqrt(5.0 / 6.0) * damping_ratio(pair.restitution)
    return Constants(
        E=E,
        G=G,
        c_n=c * sqrt(2.0 * E),
        c_t=c * sqrt(8.0 * G),
        mu=pair.sliding_friction,
    )


def choices(params: HertzMindlin, features: Features) -> Choices:
    """Return what must be compiled."""
    return Choices(
        features.damping,
        features.sliding,
        LIMITS[params.coulomb_limit],
        params.tension_cutoff,
        keeps_force=params.tangential_memory == "force",
    )


def damping_root(touch: Touch) -> float:
    """Return √(a m*), which the damping of both directions has in common."""
    return sqrt(contact_radius(touch) * (1.0 / touch.inverse_mass))


def load(touch: Touch, c: Constants, history: History, dt: float, chosen: Choices) -> tuple[ContactLoad, History]:
    """Return what the contact does to body j, and its new history."""
    elastic, root = elastic_force(touch, c), damping_root(touch) if chosen.damping else 0.0
    F_n = damped(elastic, c.c_n * root, touch, chosen)
    F_lim = limiting_force(elastic, F_n, chosen)
    F_t, xi = ZERO, history.xi
    if chosen.sliding:
        k_t, xi_old = tangential_stiffness(touch, c), history.xi
        if chosen.keeps_force:
            xi_old = scale(easing(k_t, tangential_stiffness_before(touch, c), chosen), xi_old)
        F_t, xi = sliding(touch, k_t, c.c_t * root, c.mu * F_lim, xi_old, dt, chosen)
    return ContactLoad(sub(scale(F_n, touch.normal), F_t), ZERO, ZERO, F_lim), History(xi)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer Hertz–Mindlin."""
    registry.contact_law(
        "hertz_mindlin",
        ContactLaw(
            summary="elastic spheres with Tsuji damping, Coulomb sliding",
            Params=HertzMindlin,
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
