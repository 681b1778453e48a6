"""Friction that contact laws share: a tangential spring and dashpot behind a slider, and what they dissipate.

A law brings its normal force, its tangential stiffness k_t and dashpot c_t; everything tangential is here.
"""

from __future__ import annotations

from math import sqrt
from typing import Annotated, Literal, NamedTuple

from pydantic import Field

from clast.maths.vec3 import ZERO, Vec, across, add, dot, scale, sub
from clast.parts.contact_law import ContactLoad, ContactLosses, Drag, Touch
from clast_plugins.contact_laws.rolling import rolling_heat

ELASTIC, TOTAL, MUSEN = 0, 1, 2
LIMITS = {"elastic": ELASTIC, "total": TOTAL, "musen": MUSEN}

CoulombLimit = Annotated[
    Literal["elastic", "total"], Field(description="the normal force that limits sliding and rolling")
]
TensionCutoff = Annotated[bool, Field(description="whether damping may not make a leaving contact pull")]


class Choices(NamedTuple):
    """What the scene needs of a law, known when the loop is compiled."""

    damping: bool
    sliding: bool
    rolling: bool
    limit: int
    tension_cutoff: bool
    own_spin: bool = False
    keeps_force: bool = False


class History(NamedTuple):
    """Tangential displacement of the contact since it began, in m."""

    xi: Vec


def damped(elastic: float, c_n: float, touch: Touch, chosen: Choices) -> float:
    """Return the normal force in N: an elastic one with a dashpot c_n in N s/m."""
    force = elastic
    if chosen.damping:
        force = force - c_n * dot(touch.velocity, touch.normal)
    if chosen.tension_cutoff:
        force = max(force, 0.0)
    return force


def limiting_force(elastic: float, F_n: float, chosen: Choices) -> float:
    """Return the normal force that limits friction in N."""
    if chosen.limit == ELASTIC:
        return elastic
    if chosen.limit == MUSEN:
        return abs(F_n)
    return max(F_n, 0.0)


def sliding(
    touch: Touch, k_t: float, c_t: float, limit: float, xi_old: Vec, dt: float, chosen: Choices
) -> tuple[Vec, Vec]:
    """Return the tangential force on i and the tangential displacement, Coulomb's limit kept.

    Parameters
    ----------
    touch : Touch
    k_t, c_t : float
        Spring in N/m and dashpot in N s/m.
    limit : float
        Largest tangential force in N.
    xi_old : vector
        Tangential displacement before, in m.
    dt : float
        Time since then, in s.
    chosen : Choices
    """
    xi = add(xi_old, across(touch.moved, touch.normal))
    spring = scale(k_t, xi)
    dashpot = scale(c_t, across(touch.velocity, touch.normal)) if chosen.damping else ZERO
    judged = spring if chosen.limit == MUSEN else add(spring, dashpot)
    size2 = dot(judged, judged)
    slides = size2 > limit * limit
    limited = scale(limit / sqrt(size2) if slides else 1.0, judged)
    if chosen.limit == MUSEN:
        return (limited, scale(1.0 / k_t, limited)) if slides else (add(spring, dashpot), xi)
    # while sliding, spring and dashpot give way together: k_t ξ + c_t dξ/dt is the limit
    return limited, (scale(1.0 / (k_t * dt + c_t), add(scale(dt, limited), scale(c_t, xi_old))) if slides else xi)


def easing(k_t: float, k_before: float, chosen: Choices) -> float:
    """Return by how much the tangential spring eases as its stiffness grows: k_before/k_t where it keeps its force."""
    return min(k_before / k_t, 1.0) if chosen.keeps_force else 1.0


def overlap_before(touch: Touch) -> float:
    """Return the overlap at the forces before in m, 0 where there was none."""
    return max(touch.overlap + dot(touch.moved, touch.normal), 0.0)


def frictional_losses(
    touch: Touch,
    elastic: float,
    k_t: float,
    k_before: float,
    before: Vec,
    load: ContactLoad,
    after: Vec,
    dt: float,
    chosen: Choices,
    before_drag: Drag,
) -> ContactLosses:
    """Return what dashpots, slider, rolling and the changing tangential stiffness took up since the forces before.

    Each is the mean of its force then and now, times its way. The slider has slipped by what the contact moved and the
    spring did not. The spring loses ½ Δk_t ξ² where its stiffness k_t falls by Δk_t: no force belongs to that. Where it
    keeps its force while k_t grows, it eases and loses what it held more before.

    Parameters
    ----------
    touch : Touch
    elastic : float
        Elastic part of the normal force in N.
    k_t, k_before : float
        Tangential stiffness in N/m, now and at the forces before.
    before, after : vector
        Tangential displacement in m, then and now.
    load : ContactLoad
    dt : float
    chosen : Choices
    before_drag : Drag
    """
    n = touch.normal
    opened = dot(touch.moved, n)
    drag, stretch = scale(elastic - dot(load.force, n), n), ZERO
    sliding_heat = stiffening = 0.0
    if chosen.sliding:
        eased = easing(k_t, k_before, chosen)
        stretch, F_t = sub(after, scale(eased, before)), scale(-1.0, across(load.force, n))
        slip = sub(across(touch.moved, n), stretch)
        F_before = add(scale(k_before, before), across(before_drag.force, n))
        sliding_heat = 0.5 * dot(add(F_before, F_t), slip)
        drag = add(drag, sub(F_t, scale(k_t, after)))
        lost = (k_before - eased * k_t) * dot(before, after) + (1.0 - eased) * k_before * dot(before, before)
        stiffening = 0.5 * lost
    viscous = 0.5 * dot(add(drag, before_drag.force), add(scale(opened, n), stretch))
    rolled = rolling_heat(touch, load, dt, chosen.own_spin, before_drag.torque)
    return ContactLosses(viscous, sliding_heat, rolled, stiffening, Drag(drag, load.torque_i))
