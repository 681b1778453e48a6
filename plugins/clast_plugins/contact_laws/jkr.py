"""Elastic spheres that stick: Johnson, Kendall and Roberts, with viscous damping and sliding friction."""

from __future__ import annotations

from math import pi, sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Unit
from clast.maths.vec3 import ZERO, dot, scale, sub
from clast.parts.contact_law import (
    ContactLaw,
    ContactLoad,
    ContactLosses,
    Drag,
    Features,
    MaterialPair,
    Touch,
    stretch_before,
)
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.contact_laws.damping import damping_ratio
from clast_plugins.contact_laws.friction import ELASTIC, Choices, History, damped, frictional_losses, sliding
from clast_plugins.contact_laws.moduli import normal_modulus, tangential_modulus
from clast_plugins.contact_laws.neck import contact_radius, neck_energy, neck_force, neck_reach, pull_off_force


class JKR(Params):
    r"""Elastic spheres with adhesion over their area of contact, Tsuji damping, and Coulomb sliding.

    Equation
    --------
    F = 4 E* a³/(3 R*) − √(8 π w E* a³),  δ = a²/R* − √(2 π w a/E*)
    F_n = F + c √(m* k) v_n,  k = 2 E* a
    F_t = k_t ξ + c √(m* k_t) v_t,  k_t = 8 G* a,  |F_t| ≤ μ (F + 2 F_c),  F_c = 3/2 π w R*

    Symbols
    -------
    δ, v_n : overlap in m, below 0 in a neck that holds beyond touch, and its rate in m/s
    a : radius of the area of contact in m, the larger root
    w : work of adhesion in J/m²: γ_i + γ_j − γ_ij, twice the surface energy for two bodies alike; required
    F_c : largest pull
    ξ, v_t : tangential displacement since touch in m and its rate, as in ``hertz_mindlin``
    E*, G*, R*, m* : effective moduli, radius and mass
    c : 2 √(5/6) β, β = −ln e/√(π² + ln² e), at most 1

    A contact begins at δ = 0 with a pull of 8/9 F_c, and ends at δ = −3/4 (π² w² R*/E*²)^(1/3) with 5/9 F_c.
    Without damping, spheres that meet more slowly than √(14.18/m*) (w⁵ R*⁴/E*²)^(1/6) stick.

    Limits
    ------
    Large, soft spheres with short-ranged adhesion: (R* w²/(E*² z³))^(1/3) above 5 for a range z of the surface forces.
    One w for all pairs. The coefficient of restitution is that of the dashpot; adhesion takes its own part. The neck is
    damped like the contact. No peeling by tangential force.

    Source
    ------
    Johnson, Kendall and Roberts (1971), doi:10.1098/rspa.1971.0141; end of the neck and sticking: Thornton and Ning
    (1998), doi:10.1016/S0032-5910(98)00099-0; sliding at F + 2 F_c: Thornton and Yin (1991),
    doi:10.1016/0032-5910(91)80178-L.
    """

    work_of_adhesion: Annotated[
        float, Unit("J/m2"), Field(gt=0, description="work of adhesion w of both surfaces", examples=["0.05 J/m2"])
    ]


class Constants(NamedTuple):
    """Numbers of one pair of materials; ``g`` is (2 π w/E*)^(1/3), ``c_n`` and ``c_t`` are c √(2 E*) and c √(8 G*)."""

    E: float
    G: float
    w: float
    g: float
    c_n: float
    c_t: float
    mu: float


def constants(params: JKR, pair: MaterialPair) -> Constants:
    """Compute effective moduli, adhesion and damping of a pair of materials."""
    E, G, w = normal_modulus(pair), tangential_modulus(pair), params.work_of_adhesion
    c = 2.0 * sqrt(5.0 / 6.0) * damping_ratio(pair.restitution)
    return Constants(
        E=E,
        G=G,
        w=w,
        g=float((2.0 * pi * w / E) ** (1.0 / 3.0)),
        c_n=c * sqrt(2.0 * E),
        c_t=c * sqrt(8.0 * G),
        mu=pair.sliding_friction,
    )


def choices(params: JKR, features: Features) -> Choices:
    """Return what must be compiled."""
    return Choices(features.damping, features.sliding, ELASTIC, tension_cutoff=False)


def load(touch: Touch, c: Constants, history: History, dt: float, chosen: Choices) -> tuple[ContactLoad, History]:
    """Return what the contact does to body j, and its new history."""
    a, elastic = contact_radius(touch.radius, touch.overlap, c), neck_force(touch.radius, touch.overlap, c)
    root = sqrt(a * (1.0 / touch.inverse_mass)) if chosen.damping else 0.0
    F_n = damped(elastic, c.c_n * root, touch, chosen)
    F_lim = elastic + 2.0 * pull_off_force(touch.radius, c)
    F_t, xi = ZERO, history.xi
    if chosen.sliding:
        F_t, xi = sliding(touch, 8.0 * c.G * a, c.c_t * root, c.mu * F_lim, history.xi, dt, chosen)
    return ContactLoad(sub(scale(F_n, touch.normal), F_t), ZERO, ZERO, F_lim), History(xi)


def energy(touch: Touch, c: Constants, history: History, chosen: Choices) -> float:
    """Return the work of the normal force from touch, below 0 where adhesion gave more, and ½ k_t ξ², in J."""
    stored = neck_energy(touch.radius, touch.overlap, c)
    if chosen.sliding:
        a = contact_radius(touch.radius, touch.overlap, c)
        stored = stored + 4.0 * c.G * a * dot(history.xi, history.xi)
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
    """Return what the contact has taken up since the forces before."""
    k_t = 8.0 * c.G * contact_radius(touch.radius, touch.overlap, c)
    k_before = 8.0 * c.G * contact_radius(touch.radius, stretch_before(touch), c)
    elastic = neck_force(touch.radius, touch.overlap, c)
    return frictional_losses(touch, elastic, k_t, k_before, before.xi, load, after.xi, chosen, before_drag)


def stiffness(c: Constants, radius: float, overlap: float) -> float:
    """Return 2 E* a in N/m: no neck of this radius is stiffer along its normal."""
    return 2.0 * c.E * contact_radius(radius, overlap, c)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the law of Johnson, Kendall and Roberts."""
    registry.contact_law(
        "jkr",
        ContactLaw(
            summary="elastic spheres that stick: necks that hold beyond touch, Tsuji damping, Coulomb sliding",
            Params=JKR,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            energy=energy,
            stiffness=stiffness,
            History=History,
            losses=losses,
            reach=neck_reach,
            limits_rolling=True,
        ),
    )
