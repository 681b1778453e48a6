"""How a contact law answers small motions: measured by calling it, so that its author states nothing more."""

from __future__ import annotations

from math import sqrt
from typing import Any, NamedTuple

from clast.engine.records import build, width
from clast.maths.vec3 import ZERO
from clast.parts.contact_law import ContactLaw, Touch

SMALL = 1e-6
ALONG = (0.0, 0.0, 1.0)


class Response(NamedTuple):
    """Numbers of one pair of materials, as shares of what the normal tangent stiffness k gives.

    Attributes
    ----------
    across : float
        Tangential stiffness as a share of k.
    damping_along, damping_across : float
        Damping ratios: dashpots as shares of 2 √(k m*).
    """

    across: float
    damping_along: float
    damping_across: float


def respond(law: ContactLaw, constants: Any, choices: Any, radius: float, mass: float) -> Response:
    """Return the response of two equal spheres that touch, stick and do not move.

    Central differences of the law's load over a millionth of the overlap, a hundredth of the effective radius;
    friction far from sliding. The shares are taken as the same at every overlap: with Hertz, Mindlin and Tsuji, and
    with linear springs and dashpots, they are. Rolling friction has no stiffness and counts for nothing here.

    Parameters
    ----------
    law, constants, choices : part and its records
    radius, mass : float
        Of each sphere, in m and kg.
    """
    half, per_mass = 0.5 * radius, 2.0 / mass
    overlap = 0.01 * half
    k = law.stiffness(constants, half, overlap)
    if not k > 0.0:
        return Response(0.0, 0.0, 0.0)
    history = None if law.History is None else build(law.History, [0.0] * width(law.History))
    rest = Touch(overlap, ALONG, ZERO, ZERO, ZERO, half, radius, radius, per_mass, 5.0 / (mass * radius**2))
    step = SMALL * overlap
    rate = step * sqrt(k * per_mass)

    def force(touch: Touch, axis: int) -> float:
        load, _ = law.load(touch, constants, history, step / rate, choices)
        return float(load.force[axis])

    def slope(there: Touch, back: Touch, axis: int, size: float) -> float:
        return max((force(back, axis) - force(there, axis)) / (2.0 * size), 0.0)

    moved = slope(rest._replace(moved=(step, 0.0, 0.0)), rest._replace(moved=(-step, 0.0, 0.0)), 0, step)
    shear = slope(rest._replace(velocity=(rate, 0.0, 0.0)), rest._replace(velocity=(-rate, 0.0, 0.0)), 0, rate)
    stretch = slope(rest._replace(velocity=(0.0, 0.0, rate)), rest._replace(velocity=(0.0, 0.0, -rate)), 2, rate)
    critical = 2.0 * sqrt(k / per_mass)
    return Response(moved / k, stretch / critical, shear / critical)
