"""How a contact law answers small motions: measured by calling it, so that its author states nothing more."""

from __future__ import annotations

from math import sqrt
from typing import Any, NamedTuple

from clast.engine.records import build, width
from clast.maths.vec3 import ZERO
from clast.parts.contact_law import ContactLaw, Touch
from clast.parts.rolling_resistance import Pressing, RollingResistance

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
    rolling, damping_rolling : float
        Rolling stiffness as a share of k R*², and its dashpot as a share of 2 √(k R*² I*).
    """

    across: float
    damping_along: float
    damping_across: float
    rolling: float = 0.0
    damping_rolling: float = 0.0


def rolling_response(
    rolling: RollingResistance, constants: Any, choices: Any, stiffness: float, radius: float, mass: float
) -> tuple[float, float]:
    """Return how a rolling resistance answers small rotations of two equal spheres, as shares.

    Parameters
    ----------
    rolling, constants, choices : part and its records
    stiffness : float
        Normal tangent stiffness k in N/m.
    radius, mass : float
        Of each sphere, in m and kg.

    Returns
    -------
    stiffness, damping : float
        Rolling stiffness as a share of k R*², and its dashpot as a share of 2 √(k R*² I*). Both 0 for a part without
        a History: a torque of bounded size without a spring counts for nothing here.
    """
    if rolling.History is None or not stiffness > 0.0:
        return 0.0, 0.0
    half, inertia = 0.5 * radius, 0.2 * mass * radius**2
    rest = Touch(0.01 * half, ALONG, ZERO, ZERO, ZERO, half, radius, radius, 2.0 / mass, 1.0 / inertia)
    pressing = Pressing(0.01 * half * stiffness, stiffness, stiffness)
    k, fresh = stiffness * half * half, build(rolling.History, [0.0] * width(rolling.History))
    rate = SMALL * sqrt(k / inertia)

    def torque(turned: float, spin: float) -> float:
        touch = rest._replace(turned=(turned, 0.0, 0.0), spin_i=(-0.5 * spin, 0.0, 0.0), spin_j=(0.5 * spin, 0.0, 0.0))
        load, _ = rolling.load(touch, constants, fresh, pressing, SMALL / rate, choices)
        return float(load.torque_i[0])

    spring = (torque(SMALL, 0.0) - torque(-SMALL, 0.0)) / (2.0 * SMALL)
    dashpot = (torque(0.0, rate) - torque(0.0, -rate)) / (2.0 * rate)
    return max(spring, 0.0) / k, max(dashpot, 0.0) / (2.0 * sqrt(k * inertia))


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
