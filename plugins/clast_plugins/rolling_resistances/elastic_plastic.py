"""A rolling spring and dashpot behind a slider: it holds what rests on a slope."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number
from clast.maths.vec3 import Vec, across, add, dot, scale, sub
from clast.parts.contact_law import MaterialPair, Touch
from clast.parts.params import Params
from clast.parts.rolling_resistance import Pressing, RollingLoad, RollingLosses, RollingResistance
from clast.plugins.registry import Registry
from clast_plugins.contact_laws.friction import capped, given_way, slipping

IN_CONTACT = 3.5
"""Moment of inertia of a solid sphere about its contact point, as a share of that about its centre."""


class ElasticPlastic(Params):
    r"""A torque that winds up with the rolling until it reaches the friction, and unwinds when the rolling turns round.

    Equation
    --------
    M = k_r θ + c_r ω_r,  |M| ≤ μ_r F_lim R*
    k_r = s k_n (μ_r R*)²,  c_r = 2 η √(I_r k_r),  I_r = 7/2 I*

    Symbols
    -------
    θ, ω_r : relative rotation across the normal since touch in rad and its rate; θ turns with the contact plane. While
        the contact rolls on, spring and dashpot together give way in front of a slider: k_r θ + c_r dθ/dt is the limit
    μ_r : coefficient of rolling friction of the pair, the tangent of the steepest slope on which a sphere rests
    k_n : normal tangent stiffness, from the contact law, in N/m
    F_lim : the normal force that limits friction, from the contact law, in N
    R*, I* : effective radius; 1/I* = 1/I_i + 1/I_j
    s, η : ``stiffness`` and ``damping``

    Limits
    ------
    Rolling only, no resistance to twisting about the normal. The spring tightens and eases with k_n as that of
    ``hertz_mindlin`` does; the energy ledger tells it as stiffening of contacts.

    Source
    ------
    Iwashita and Oda (1998), doi:10.1061/(ASCE)0733-9399(1998)124:3(285); Ai, Chen, Rotter and Ooi (2011), model C,
    doi:10.1016/j.powtec.2010.09.030, where spring and dashpot are limited apart.
    """

    stiffness: Annotated[
        Number, Field(gt=0, description="rolling stiffness over k_n (μ_r R*)², s; 2.25 and 3 are in use")
    ] = 2.25
    damping: Annotated[Number, Field(ge=0, description="damping ratio of the rolling spring, η")] = 0.3


class Constants(NamedTuple):
    """Numbers of one pair of materials: coefficient of friction, s μ_r², and 2 η √(7/2)."""

    mu: float
    spring: float
    dashpot: float


class Choices(NamedTuple):
    """What must be compiled."""

    damping: bool


class History(NamedTuple):
    """Rotation of the rolling spring in rad."""

    theta: Vec


def constants(params: ElasticPlastic, pair: MaterialPair) -> Constants:
    """Return the numbers of a pair of materials."""
    mu = pair.rolling_friction
    return Constants(mu, params.stiffness * mu * mu, 2.0 * params.damping * sqrt(IN_CONTACT))


def choices(params: ElasticPlastic) -> Choices:
    """Return what must be compiled."""
    return Choices(params.damping > 0.0)


def rolling_stiffness(c: Constants, radius: float, k_n: float) -> float:
    """Return k_r in N m."""
    return c.spring * k_n * radius * radius


def load(
    touch: Touch, c: Constants, history: History, pressing: Pressing, dt: float, chosen: Choices
) -> tuple[RollingLoad, History]:
    """Return the rolling torques on both bodies, and the rotation of the spring."""
    k = rolling_stiffness(c, touch.radius, pressing.stiffness)
    c_r = c.dashpot * sqrt(k * (1.0 / touch.inverse_inertia)) if chosen.damping else 0.0
    theta = add(history.theta, across(touch.turned, touch.normal))
    rate = across(sub(touch.spin_j, touch.spin_i), touch.normal)
    torque, rolls = capped(add(scale(k, theta), scale(c_r, rate)), c.mu * pressing.limit * touch.radius)
    # where neither spring nor dashpot acts, nothing gives way
    kept = given_way(k, c_r, torque, history.theta, dt) if rolls and k > 0.0 else theta
    return RollingLoad(torque, scale(-1.0, torque)), History(kept)


def losses(
    touch: Touch,
    c: Constants,
    before: History,
    load: RollingLoad,
    after: History,
    pressing: Pressing,
    dt: float,
    chosen: Choices,
    drag: Vec,
) -> RollingLosses:
    """Return what slider, dashpot and the changing stiffness took up since the forces before."""
    k = rolling_stiffness(c, touch.radius, pressing.stiffness)
    k_before = rolling_stiffness(c, touch.radius, pressing.stiffness_before)
    way = across(touch.turned, touch.normal)
    lost = slipping(way, k, k_before, 1.0, before.theta, after.theta, load.torque_i, drag)
    return RollingLosses(lost.slider + 0.5 * dot(add(lost.drag, drag), lost.stretch), lost.stiffening, lost.drag)


def energy(c: Constants, history: History, radius: float, stiffness: float) -> float:
    """Return ½ k_r θ² in J."""
    return 0.5 * rolling_stiffness(c, radius, stiffness) * dot(history.theta, history.theta)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the elastic-plastic spring and dashpot."""
    registry.rolling_resistance(
        "elastic_plastic",
        RollingResistance(
            summary="a rolling spring and dashpot behind a slider; it holds what rests on a slope",
            Params=ElasticPlastic,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            losses=losses,
            energy=energy,
            History=History,
        ),
    )
