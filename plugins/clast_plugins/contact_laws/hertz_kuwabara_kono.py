"""Hertz contact of viscoelastic spheres, with Coulomb sliding."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Time
from clast.maths.vec3 import ZERO, scale, sub
from clast.parts.contact_law import ContactLaw, ContactLoad, Features, MaterialPair, Touch
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.contact_laws.friction import (
    LIMITS,
    Choices,
    CoulombLimit,
    History,
    TensionCutoff,
    damped,
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
)
from clast_plugins.contact_laws.moduli import normal_modulus, tangential_modulus


class HertzKuwabaraKono(Params):
    r"""Spheres whose material is viscous: a force in proportion to Hertz's stiffness and to the rate of the overlap.

    Equation
    --------
    F_n = 4/3 E* √R* (δ^3/2 + 3/2 A √δ v_n) = 4/3 E* a δ + A k_n v_n,  k_n = 2 E* a,  a = √(R* δ)
    F_t = k_t (ξ + A v_t),  k_t = 8 G* a,  |F_t| ≤ μ F_lim

    Symbols
    -------
    δ, v_n : overlap in m and its rate in m/s
    ξ, v_t : tangential displacement since touch in m and its rate, as in ``hertz_mindlin``
    E*, G*, R* : effective moduli and radius
    A : dissipative time in s, required: of the viscosities and the elastic moduli of the material
    F_lim : elastic part of F_n (``elastic``), or its positive total (``total``)

    The coefficient of restitution falls with the speed v of an impact, with x = A κ^2/5 v^1/5 and
    κ = (3/2)^5/2 · 4/3 E* √R*/m*:  e = 1 − 1.15345 x + 0.798267 x² − 0.483582 x³ + 0.285279 x⁴ ∓ …
    So pairs have no ``restitution`` of their own.

    Options
    -------
    ``tension_cutoff: true`` never lets F_n pull: the contact then ends when the force does, and e is a little larger.

    Limits
    ------
    One dissipative time for all pairs of materials; slow against the speed of sound, δ̇ ≪ c δ/R; small overlaps; no
    adhesion. The dashpot grows with √δ, so the force sets in smoothly and errors fall with nearly the square of the
    step; the limit of the time step counts the dashpot as it is at an overlap of a hundredth of R*.

    Source
    ------
    Kuwabara and Kono (1987), doi:10.1143/JJAP.26.1230; Brilliantov, Spahn, Hertzsch and Pöschel (1996),
    doi:10.1103/PhysRevE.53.5382; series: Schwager and Pöschel (1998), doi:10.1103/PhysRevE.57.650.
    """

    dissipative_time: Annotated[Time, Field(ge=0, description="dissipative time A", examples=["1 us"])]
    coulomb_limit: CoulombLimit = "elastic"
    tension_cutoff: TensionCutoff = False


class Constants(NamedTuple):
    """Numbers of one pair of materials."""

    E: float
    G: float
    A: float
    mu: float


def damping(params: HertzKuwabaraKono) -> bool:
    """Tell whether the material is viscous."""
    return params.dissipative_time > 0.0


def constants(params: HertzKuwabaraKono, pair: MaterialPair) -> Constants:
    """Compute effective moduli of a pair of materials."""
    E, G = normal_modulus(pair), tangential_modulus(pair)
    return Constants(E, G, params.dissipative_time, pair.sliding_friction)


def choices(params: HertzKuwabaraKono, features: Features) -> Choices:
    """Return what must be compiled."""
    return Choices(features.damping, features.sliding, LIMITS[params.coulomb_limit], params.tension_cutoff)


def load(touch: Touch, c: Constants, history: History, dt: float, chosen: Choices) -> tuple[ContactLoad, History]:
    """Return what the contact does to body j, and its new history."""
    elastic = elastic_force(touch, c)
    F_n = damped(elastic, c.A * (2.0 * c.E * contact_radius(touch)), touch, chosen)
    F_lim = limiting_force(elastic, F_n, chosen)
    F_t, xi = ZERO, history.xi
    if chosen.sliding:
        k_t = tangential_stiffness(touch, c)
        F_t, xi = sliding(touch, k_t, c.A * k_t, c.mu * F_lim, history.xi, dt, chosen)
    return ContactLoad(sub(scale(F_n, touch.normal), F_t), ZERO, ZERO, F_lim), History(xi)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer Hertz's contact with the viscosity of Kuwabara and Kono."""
    registry.contact_law(
        "hertz_kuwabara_kono",
        ContactLaw(
            summary="viscoelastic spheres, whose restitution falls with speed; Coulomb sliding",
            Params=HertzKuwabaraKono,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            energy=energy,
            stiffness=stiffness,
            History=History,
            losses=losses,
            limits_rolling=True,
            damping=damping,
        ),
    )
