"""Hertz–Mindlin contact with viscous damping, sliding and rolling friction."""

from __future__ import annotations

from math import log, pi, sqrt
from typing import Annotated, Literal, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.maths.vec3 import ZERO, Vec, across, add, dot, norm, scale, sub
from clast.parts.contact_law import ContactLaw, ContactLoad, ContactLosses, Drag, Features, MaterialPair, Touch
from clast.parts.params import Params
from clast.plugins.registry import Registry

ELASTIC, TOTAL, MUSEN = 0, 1, 2
BRAKING_STEPS = 20.0
"""Steps in which rolling friction may stop a rolling at the soonest: more than the twelve contacts that a particle
among equal ones has, which all brake it at once."""

LIMITS = {"elastic": ELASTIC, "total": TOTAL, "musen": MUSEN}


class HertzMindlin(Params):
    r"""Elastic spheres with Tsuji damping, Coulomb sliding and a constant rolling torque.

    Equation
    --------
    F_n = 4/3 E* √(R* δ) δ + c √(m* k_n) v_n,  k_n = 2 E* √(R* δ)
    F_t = k_t ξ + c √(m* k_t) v_t,  k_t = 8 G* √(R* δ),  |F_t| ≤ μ F_lim
    M_r = μ_r F_lim R* against the rolling

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
    sliding, as the paper's authors' program does: for comparison only. ``rolling: own_spin`` acts against each
    particle's own spin as that program does: neither objective nor quiet at rest.
    ``tension_cutoff: true`` never lets F_n pull; the coefficient of restitution is then not e but larger.

    Limits
    ------
    Small overlaps; no adhesion; tangential stiffness at the present overlap without unloading correction. A cylinder
    wall counts as flat.

    Source
    ------
    Hertz (1882); Mindlin and Deresiewicz (1953); Tsuji, Tanaka and Ishida (1992), doi:10.1016/0032-5910(92)88030-L;
    rolling: Ai et al. (2011), model A, doi:10.1016/j.powtec.2010.09.030.
    """

    coulomb_limit: Annotated[
        Literal["elastic", "total", "musen"],
        Field(description="the normal force that limits sliding and rolling"),
    ] = "elastic"
    tension_cutoff: Annotated[bool, Field(description="whether damping may not make a leaving contact pull")] = False
    rolling: Annotated[
        Literal["relative", "own_spin"], Field(description="the spin that rolling friction acts against")
    ] = "relative"


class Constants(NamedTuple):
    """Numbers of one pair of materials; ``c_n`` and ``c_t`` are c √(2 E*) and c √(8 G*)."""

    E: float
    G: float
    c_n: float
    c_t: float
    mu: float
    mu_r: float


class Choices(NamedTuple):
    """What the scene needs of the law, known when the loop is compiled."""

    damping: bool
    sliding: bool
    rolling: bool
    limit: int
    tension_cutoff: bool
    own_spin: bool


class History(NamedTuple):
    """Tangential displacement of the contact since it began, in m."""

    xi: Vec


def damping_ratio(restitution: float) -> float:
    """Return β of Tsuji's damping for a coefficient of restitution; the limit 1 at 0.

    >>> damping_ratio(1.0), damping_ratio(0.0)
    (0.0, 1.0)
    """
    if restitution == 0.0:
        return 1.0
    ln_e = log(restitution)
    return abs(ln_e) / sqrt(pi * pi + ln_e * ln_e)


def constants(params: HertzMindlin, pair: MaterialPair) -> Constants:
    """Compute effective moduli and damping of a pair of materials."""
    nu_i, nu_j = pair.poisson_ratio_i, pair.poisson_ratio_j
    G_i = pair.young_modulus_i / (2.0 * (1.0 + nu_i))
    G_j = pair.young_modulus_j / (2.0 * (1.0 + nu_j))
    E = 1.0 / ((1.0 - nu_i**2) / pair.young_modulus_i + (1.0 - nu_j**2) / pair.young_modulus_j)
    G = 1.0 / ((2.0 - nu_i) / G_i + (2.0 - nu_j) / G_j)
    c = 2.0 * sqrt(5.0 / 6.0) * damping_ratio(pair.restitution)
    return Constants(
        E=E,
        G=G,
        c_n=c * sqrt(2.0 * E),
        c_t=c * sqrt(8.0 * G),
        mu=pair.sliding_friction,
        mu_r=pair.rolling_friction,
    )


def choices(params: HertzMindlin, features: Features) -> Choices:
    """Return what must be compiled."""
    return Choices(
        *features,
        limit=LIMITS[params.coulomb_limit],
        tension_cutoff=params.tension_cutoff,
        own_spin=params.rolling == "own_spin",
    )


def contact_radius(touch: Touch) -> float:
    """Return a = √(R* δ) in m."""
    return sqrt(touch.radius * touch.overlap)


def damping_root(touch: Touch) -> float:
    """Return √(a m*), which the damping of both directions has in common."""
    return sqrt(contact_radius(touch) * (1.0 / touch.inverse_mass))


def elastic_force(touch: Touch, c: Constants) -> float:
    """Return Hertz's repulsion in N."""
    return 4.0 / 3.0 * c.E * contact_radius(touch) * touch.overlap


def normal_force(touch: Touch, c: Constants, chosen: Choices) -> float:
    """Return the repulsion with damping in N."""
    force = elastic_force(touch, c)
    if chosen.damping:
        force = force - c.c_n * damping_root(touch) * dot(touch.velocity, touch.normal)
    if chosen.tension_cutoff:
        force = max(force, 0.0)
    return force


def limiting_force(touch: Touch, c: Constants, F_n: float, chosen: Choices) -> float:
    """Return the normal force that limits friction in N."""
    if chosen.limit == ELASTIC:
        return elastic_force(touch, c)
    if chosen.limit == MUSEN:
        return abs(F_n)
    return max(F_n, 0.0)


def sliding(touch: Touch, c: Constants, xi_old: Vec, F_lim: float, dt: float, chosen: Choices) -> tuple[Vec, Vec]:
    """Return the tangential force on i in N and the tangential displacement in m, Coulomb's limit kept."""
    k_t = 8.0 * c.G * contact_radius(touch)
    c_t = c.c_t * damping_root(touch) if chosen.damping else 0.0
    xi = add(xi_old, across(touch.moved, touch.normal))
    spring = scale(k_t, xi)
    dashpot = scale(c_t, across(touch.velocity, touch.normal)) if chosen.damping else ZERO
    judged = spring if chosen.limit == MUSEN else add(spring, dashpot)
    size2, limit = dot(judged, judged), c.mu * F_lim
    slides = size2 > limit * limit
    limited = scale(limit / sqrt(size2) if slides else 1.0, judged)
    if chosen.limit == MUSEN:
        return (limited, scale(1.0 / k_t, limited)) if slides else (add(spring, dashpot), xi)
    # while sliding, spring and dashpot give way together: k_t ξ + c_t dξ/dt is the limit
    return limited, (scale(1.0 / (k_t * dt + c_t), add(scale(dt, limited), scale(c_t, xi_old))) if slides else xi)


def rolling(touch: Touch, c: Constants, F_lim: float, dt: float, chosen: Choices) -> tuple[Vec, Vec]:
    """Return the rolling torques on i and j in N m."""
    if chosen.own_spin:
        own_i = against(touch.spin_i, c.mu_r * F_lim * touch.radius_i)
        return own_i, against(touch.spin_j, c.mu_r * F_lim * touch.radius_j)
    relative = across(sub(touch.spin_j, touch.spin_i), touch.normal)
    rate = norm(relative)
    # never so much that all contacts of a particle together, or the lag of the spins they see, could turn it round
    stopping = 1.0 / (BRAKING_STEPS * touch.inverse_inertia * dt)
    drag = min(c.mu_r * F_lim * touch.radius / rate, stopping) if rate > 0.0 else 0.0
    torque = scale(drag, relative)
    return torque, scale(-1.0, torque)


def against(spin: Vec, size: float) -> Vec:
    """Return a torque of a given size against a spin."""
    rate = norm(spin)
    return scale(-size / rate if rate > 0.0 else 0.0, spin)


def load(touch: Touch, c: Constants, history: History, dt: float, chosen: Choices) -> tuple[ContactLoad, History]:
    """Return what the contact does to body j, and its new history."""
    F_n = normal_force(touch, c, chosen)
    F_lim = limiting_force(touch, c, F_n, chosen)
    F_t, xi = ZERO, history.xi
    if chosen.sliding:
        F_t, xi = sliding(touch, c, history.xi, F_lim, dt, chosen)
    torque_i, torque_j = ZERO, ZERO
    if chosen.rolling:
        torque_i, torque_j = rolling(touch, c, F_lim, dt, chosen)
    return ContactLoad(sub(scale(F_n, touch.normal), F_t), torque_i, torque_j), History(xi)


def energy(touch: Touch, c: Constants, history: History, chosen: Choices) -> float:
    """Return 2/5 F δ + ½ k_t ξ² in J."""
    stored = 0.4 * elastic_force(touch, c) * touch.overlap
    if chosen.sliding:
        stored = stored + 4.0 * c.G * contact_radius(touch) * dot(history.xi, history.xi)
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
    """Return what dashpots, slider, rolling and the changing tangential stiffness took up since the forces before.

    Each is the mean of its force then and now, times its way. The slider has slipped by what the contact moved and the
    spring did not. The spring loses ½ Δk_t ξ² where its stiffness k_t falls by Δk_t: Mindlin's law has no such force.
    """
    n = touch.normal
    opened = dot(touch.moved, n)
    drag, stretch = scale(elastic_force(touch, c) - dot(load.force, n), n), ZERO
    sliding_heat = stiffening = 0.0
    if chosen.sliding:
        overlap_before = max(touch.overlap + opened, 0.0)
        k_t, k_before = 8.0 * c.G * contact_radius(touch), 8.0 * c.G * sqrt(touch.radius * overlap_before)
        stretch, F_t = sub(after.xi, before.xi), scale(-1.0, across(load.force, n))
        slip = sub(across(touch.moved, n), stretch)
        F_before = add(scale(k_before, before.xi), across(before_drag.force, n))
        sliding_heat = 0.5 * dot(add(F_before, F_t), slip)
        drag = add(drag, sub(F_t, scale(k_t, after.xi)))
        stiffening = 0.5 * (k_before - k_t) * dot(before.xi, after.xi)
    viscous = 0.5 * dot(add(drag, before_drag.force), add(scale(opened, n), stretch))
    rolling_heat = 0.5 * dot(add(load.torque_i, before_drag.torque), touch.turned)
    if chosen.own_spin:
        rolling_heat = -dt * (dot(load.torque_i, touch.spin_i) + dot(load.torque_j, touch.spin_j))
    return ContactLosses(viscous, sliding_heat, rolling_heat, stiffening, Drag(drag, load.torque_i))


def stiffness(c: Constants, radius: float, overlap: float) -> float:
    """Return the normal tangent stiffness 2 E* √(R* δ) in N/m."""
    return 2.0 * c.E * sqrt(radius * overlap)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer Hertz–Mindlin."""
    registry.contact_law(
        "hertz_mindlin",
        ContactLaw(
            summary="elastic spheres with Tsuji damping, Coulomb sliding and rolling friction",
            Params=HertzMindlin,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            energy=energy,
            stiffness=stiffness,
            History=History,
            losses=losses,
        ),
    )
