"""Hertz's elastic contact with Mindlin's tangential stiffness: what laws that differ in their damping share.

Their ``Constants`` hold the effective moduli ``E`` and ``G`` in Pa.
"""

from __future__ import annotations

from math import sqrt
from typing import Protocol

from clast.maths.vec3 import dot
from clast.parts.contact_law import ContactLoad, ContactLosses, Drag, Touch, overlap_before
from clast_plugins.contact_laws.friction import Choices, History, frictional_losses


class Moduli(Protocol):
    """Numbers of one pair of materials that hold its effective moduli in Pa."""

    @property
    def E(self) -> float:
        """E*, 1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j."""

    @property
    def G(self) -> float:
        """G*, 1/G* = (2 − ν_i)/G_i + (2 − ν_j)/G_j."""


def contact_radius(touch: Touch) -> float:
    """Return a = √(R* δ) in m."""
    return sqrt(touch.radius * touch.overlap)


def elastic_force(touch: Touch, c: Moduli) -> float:
    """Return Hertz's repulsion 4/3 E* a δ in N."""
    return 4.0 / 3.0 * c.E * contact_radius(touch) * touch.overlap


def tangential_stiffness(touch: Touch, c: Moduli) -> float:
    """Return k_t = 8 G* a in N/m."""
    return 8.0 * c.G * contact_radius(touch)


def tangential_stiffness_before(touch: Touch, c: Moduli) -> float:
    """Return k_t at the forces before in N/m."""
    return 8.0 * c.G * sqrt(touch.radius * overlap_before(touch))


def energy(touch: Touch, c: Moduli, history: History, chosen: Choices) -> float:
    """Return 2/5 F δ + ½ k_t ξ² in J."""
    stored = 0.4 * elastic_force(touch, c) * touch.overlap
    if chosen.sliding:
        stored = stored + 4.0 * c.G * contact_radius(touch) * dot(history.xi, history.xi)
    return stored


def losses(
    touch: Touch,
    c: Moduli,
    before: History,
    load: ContactLoad,
    after: History,
    dt: float,
    chosen: Choices,
    before_drag: Drag,
) -> ContactLosses:
    """Return what the contact has taken up since the forces before."""
    k_t, k_before, elastic = (
        tangential_stiffness(touch, c),
        tangential_stiffness_before(touch, c),
        elastic_force(touch, c),
    )
    return frictional_losses(touch, elastic, k_t, k_before, before.xi, load, after.xi, chosen, before_drag)


def stiffness(c: Moduli, radius: float, overlap: float) -> float:
    """Return the normal tangent stiffness 2 E* √(R* δ) in N/m."""
    return 2.0 * c.E * sqrt(radius * overlap)
