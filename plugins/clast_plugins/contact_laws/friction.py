"""Friction that contact laws share: a tangential spring and dashpot behind a slider, and what they dissipate.

A law brings its normal force, its tangential stiffness k_t and dashpot c_t; everything tangential is here.
"""

from __future__ import annotations

from math import sqrt
from typing import Annotated, Literal, NamedTuple

from pydantic import Field

from clast.maths.vec3 import ZERO, Vec, across, add, dot, scale, sub
from clast.parts.contact_law import ContactLoad, ContactLosses, Drag, Touch

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
    limit: int
    tension_cutoff: bool
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
    if chosen.limit == MUSEN:
        limited, slides = capped(spring, limit)
        return (limited, scale(1.0 / k_t, limited)) if slides else (add(spring, dashpot), xi)
    limited, slides = capped(add(spring, dashpot), limit)
    return limited, (given_way(k_t, c_t, limited, xi_old, dt) if slides else xi)


def capped(force: Vec, limit: float) -> tuple[Vec, bool]:
    """Return a force, shortened to its limit where it is larger, and whether it is."""
    size2 = dot(force, force)
    larger = size2 > limit * limit
    return scale(limit / sqrt(size2) if larger else 1.0, force), larger


def given_way(k: float, c: float, limited: Vec, stretch: Vec, dt: float) -> Vec:
    """Return the stretch of a spring that gives way together with its dashpot: k ξ + c dξ/dt is the limit."""
    return scale(1.0 / (k * dt + c), add(scale(dt, limited), scale(c, stretch)))


def easing(k_t: float, k_before: float, chosen: Choices) -> float:
    """Return by how much the tangential spring eases as its stiffness grows: k_before/k_t where it keeps its force."""
    return min(k_before / k_t, 1.0) if chosen.keeps_force else 1.0


class Slipping(NamedTuple):
    """What a spring and dashpot behind a slider took up: heat of the slider and stiffening in J, stretch, drag."""

    slider: float
    stiffening: float
    stretch: Vec
    drag: Vec


def slipping(
    way: Vec, k: float, k_before: float, eased: float, before: Vec, after: Vec, F: Vec, drag_before: Vec
) -> Slipping:
    """Return what a spring and dashpot behind a slider took up since the forces before, but for the dashpot's heat.

    Parameters
    ----------
    way : vector
        What all three together moved.
    k, k_before : float
        Stiffness now and then.
    eased : float
        Share of its stretch that the spring kept as its stiffness changed.
    before, after : vector
        Stretch of the spring then and now.
    F, drag_before : vector
        Force of spring and dashpot now, and of the dashpot then.
    """
    stretch = sub(after, scale(eased, before))
    slider = 0.5 * dot(add(add(scale(k_before, before), drag_before), F), sub(way, stretch))
    lost = (k_before - eased * k) * dot(before, after) + (1.0 - eased) * k_before * dot(before, before)
    return Slipping(slider, 0.5 * lost, stretch, sub(F, scale(k, after)))


def frictional_losses(
    touch: Touch,
    elastic: float,
    k_t: float,
    k_before: float,
    before: Vec,
    load: ContactLoad,
    after: Vec,
    chosen: Choices,
    before_drag: Drag,
) -> ContactLosses:
    """Return what dashpots, slider and the changing tangential stiffness took up since the forces before.

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
    chosen : Choices
    before_drag : Drag
    """
    n = touch.normal
    opened = dot(touch.moved, n)
    drag, stretch = scale(elastic - dot(load.force, n), n), ZERO
    sliding_heat = stiffening = 0.0
    if chosen.sliding:
        eased, F_t = easing(k_t, k_before, chosen), scale(-1.0, across(load.force, n))
        way, drag_t = across(touch.moved, n), across(before_drag.force, n)
        lost = slipping(way, k_t, k_before, eased, before, after, F_t, drag_t)
        sliding_heat, stiffening, stretch, drag = lost.slider, lost.stiffening, lost.stretch, add(drag, lost.drag)
    viscous = 0.5 * dot(add(drag, before_drag.force), add(scale(opened, n), stretch))
    return ContactLosses(viscous, sliding_heat, 0.0, stiffening, Drag(drag, ZERO))
