"""Elastic-plastic spheres that stick: a piecewise linear law with hysteresis."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

from pydantic import Field, model_validator

from clast import hookimpl
from clast.config.quantities import Number, Unit
from clast.maths.vec3 import ZERO, Vec, dot, scale, sub
from clast.parts.contact_law import (
    ContactLaw,
    ContactLoad,
    ContactLosses,
    Drag,
    Features,
    MaterialPair,
    Touch,
    overlap_before,
)
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.contact_laws.damping import damping_ratio
from clast_plugins.contact_laws.friction import ELASTIC, Choices, damped, frictional_losses, sliding


class Luding(Params):
    r"""Linear loading, stiffer unloading that ends at a lasting overlap, and a force that then pulls.

    Equation
    --------
    F = k_2 (δ − δ_0),  δ_0 = (1 − k_1/k_2) δ_max,  k_2 = k_1 + (k_p − k_1) δ_max/δ_p, at most k_p
    δ_max grows so that F ≤ k_1 δ while δ_max < δ_p, and shrinks so that F ≥ −k_c δ
    F_n = F + 2 β √(m* k_1) v_n
    F_t = k_t ξ + 2 β √(m* k_t) v_t,  k_t = κ k_1,  |F_t| ≤ μ (F + k_c δ)

    Symbols
    -------
    δ, v_n : overlap in m and its rate in m/s
    δ_max : largest overlap so far, as far as it is not forgotten while the contact is pulled apart; at most δ_p
    δ_p : k_p/(k_p − k_1) φ 2 R*, the overlap at which k_2 reaches k_p; beyond, loading and unloading follow k_p alike
    ξ, v_t : tangential displacement since touch in m and its rate, as in ``hertz_mindlin``
    k_1, k_p, k_c : stiffness of first loading, largest of unloading, and of the pull, in N/m; the first two required
    φ : plasticity depth as a share of 2 R*;  κ : ratio of the tangential stiffness to k_1
    β : −ln e/√(π² + ln² e): the dashpot that rebounds with e where nothing yields; 0 for restitution 1

    Limits
    ------
    Contacts begin and end at δ = 0. The stiffness is a number of the law, the same for small and large spheres, but the
    overlap at which it saturates grows with R*. Tangential stiffness does not follow k_2.

    Source
    ------
    Luding (2008), doi:10.1007/s10035-008-0099-x, Sect. 2.3; there δ_max is not told while the contact is pulled apart:
    here k_2 follows it, so that the law is one function of δ and δ_max.
    """

    loading_stiffness: Annotated[
        float, Unit("N/m"), Field(gt=0, description="stiffness of first loading, k_1", examples=["100 kN/m"])
    ]
    unloading_stiffness: Annotated[
        float, Unit("N/m"), Field(gt=0, description="largest stiffness of unloading, k_p", examples=["400 kN/m"])
    ]
    cohesion_stiffness: Annotated[
        float, Unit("N/m"), Field(ge=0, description="stiffness of the pull, k_c", examples=["50 kN/m"])
    ] = 0.0
    plasticity_depth: Annotated[
        Number, Field(gt=0, description="lasting overlap at full plasticity over 2 R*, φ", examples=[0.05])
    ] = 0.05
    stiffness_ratio: Annotated[Number, Field(gt=0, description="tangential stiffness over k_1, κ")] = 2.0 / 7.0

    @model_validator(mode="after")
    def _unloading_is_stiffer(self) -> Luding:
        if self.unloading_stiffness <= self.loading_stiffness:
            raise ValueError(
                f"unloading_stiffness {self.unloading_stiffness:g} N/m must be larger than loading_stiffness "
                f"{self.loading_stiffness:g} N/m"
            )
        return self


class Constants(NamedTuple):
    """Numbers of one pair of materials; ``growth`` is (k_p − k_1)/(δ_p/R*), ``reach`` is δ_p/R*."""

    k_1: float
    k_p: float
    k_c: float
    growth: float
    reach: float
    k_t: float
    c_n: float
    c_t: float
    mu: float


class History(NamedTuple):
    """Tangential displacement since touch and the largest overlap, in m."""

    xi: Vec
    deepest: float


def constants(params: Luding, pair: MaterialPair) -> Constants:
    """Compute the numbers of a pair of materials."""
    k_1, k_p = params.loading_stiffness, params.unloading_stiffness
    reach = 2.0 * params.plasticity_depth * k_p / (k_p - k_1)
    k_t, c = params.stiffness_ratio * k_1, 2.0 * damping_ratio(pair.restitution)
    return Constants(
        k_1=k_1,
        k_p=k_p,
        k_c=params.cohesion_stiffness,
        growth=(k_p - k_1) / reach,
        reach=reach,
        k_t=k_t,
        c_n=c * sqrt(k_1),
        c_t=c * sqrt(k_t),
        mu=pair.sliding_friction,
    )


def choices(params: Luding, features: Features) -> Choices:
    """Return what must be compiled."""
    return Choices(features.damping, features.sliding, ELASTIC, tension_cutoff=False)


def unloading_stiffness(radius: float, c: Constants, deepest: float) -> float:
    """Return k_2 in N/m."""
    return c.k_1 + c.growth * deepest / radius


def spring_force(radius: float, c: Constants, overlap: float, deepest: float) -> float:
    """Return k_2 (δ − δ_0) in N."""
    k_2 = unloading_stiffness(radius, c, deepest)
    return k_2 * overlap - (k_2 - c.k_1) * deepest


def flow(radius: float, c: Constants, overlap: float, before: float) -> float:
    """Return the largest overlap that is remembered: pushed up by loading, and down where the contact would pull more.

    At the lower end the force is k_1 δ, at the upper one −k_c δ: growth/R* δ_max (δ_max − δ) = (k_1 + k_c) δ.
    """
    most = 0.5 * (overlap + sqrt(overlap * (overlap + 4.0 * (c.k_1 + c.k_c) * radius / c.growth)))
    return min(max(before, overlap), most, c.reach * radius)


def yielding_force(radius: float, c: Constants, overlap: float, deepest: float) -> float:
    """Return what drives δ_max: the energy it takes up for each metre that it grows, in N."""
    s = c.growth / radius
    k_2 = c.k_1 + s * deepest
    stretch = overlap - s * deepest * deepest / k_2
    return stretch * (s * deepest * (2.0 * k_2 - s * deepest) / k_2 - 0.5 * s * stretch)


def load(touch: Touch, c: Constants, history: History, dt: float, chosen: Choices) -> tuple[ContactLoad, History]:
    """Return what the contact does to body j, and its new history."""
    deepest = flow(touch.radius, c, touch.overlap, history.deepest)
    elastic = spring_force(touch.radius, c, touch.overlap, deepest)
    root = sqrt(1.0 / touch.inverse_mass) if chosen.damping else 0.0
    F_n = damped(elastic, c.c_n * root, touch, chosen)
    F_lim = max(elastic + c.k_c * touch.overlap, 0.0)
    F_t, xi = ZERO, history.xi
    if chosen.sliding:
        F_t, xi = sliding(touch, c.k_t, c.c_t * root, c.mu * F_lim, history.xi, dt, chosen)
    return ContactLoad(sub(scale(F_n, touch.normal), F_t), ZERO, ZERO, F_lim), History(xi, deepest)


def energy(touch: Touch, c: Constants, history: History, chosen: Choices) -> float:
    """Return ½ k_2 (δ − δ_0)² + ½ k_t ξ² in J."""
    F = spring_force(touch.radius, c, touch.overlap, history.deepest)
    stored = 0.5 * F * F / unloading_stiffness(touch.radius, c, history.deepest)
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
    """Return what the contact has taken up since the forces before: as ``linear``, and the work of yielding."""
    elastic = spring_force(touch.radius, c, touch.overlap, after.deepest)
    lost = frictional_losses(touch, elastic, c.k_t, c.k_t, before.xi, load, after.xi, chosen, before_drag)
    then = yielding_force(touch.radius, c, overlap_before(touch), before.deepest)
    now = yielding_force(touch.radius, c, touch.overlap, after.deepest)
    plastic = 0.5 * (then + now) * (after.deepest - before.deepest)
    return ContactLosses(lost.viscous, lost.sliding, lost.rolling, lost.stiffening, lost.drag, plastic)


def stiffness(c: Constants, radius: float, overlap: float) -> float:
    """Return k_p in N/m: no contact is stiffer, loaded or unloaded."""
    return c.k_p


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer Luding's law."""
    registry.contact_law(
        "luding",
        ContactLaw(
            summary="elastic-plastic spheres that stick: piecewise linear with hysteresis, Coulomb sliding",
            Params=Luding,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            energy=energy,
            stiffness=stiffness,
            History=History,
            losses=losses,
            yields=True,
            limits_rolling=True,
        ),
    )
