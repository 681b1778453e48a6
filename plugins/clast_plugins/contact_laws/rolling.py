"""Rolling resistance that contact laws share: a torque of constant size."""

from __future__ import annotations

from clast.maths.vec3 import Vec, across, add, dot, norm, scale, sub
from clast.parts.contact_law import ContactLoad, Touch

BRAKING_STEPS = 20.0
"""Steps in which rolling friction may stop a rolling at the soonest: more than the twelve contacts that a particle
among equal ones has, which all brake it at once."""


def rolling(touch: Touch, mu_r: float, F_lim: float, dt: float, own_spin: bool) -> tuple[Vec, Vec]:
    """Return the rolling torques on i and j in N m; Ai et al. (2011), model A."""
    if own_spin:
        own_i = against(touch.spin_i, mu_r * F_lim * touch.radius_i)
        return own_i, against(touch.spin_j, mu_r * F_lim * touch.radius_j)
    relative = across(sub(touch.spin_j, touch.spin_i), touch.normal)
    rate = norm(relative)
    # never so much that all contacts of a particle together, or the lag of the spins they see, could turn it round
    stopping = 1.0 / (BRAKING_STEPS * touch.inverse_inertia * dt)
    drag = min(mu_r * F_lim * touch.radius / rate, stopping) if rate > 0.0 else 0.0
    torque = scale(drag, relative)
    return torque, scale(-1.0, torque)


def against(spin: Vec, size: float) -> Vec:
    """Return a torque of a given size against a spin."""
    rate = norm(spin)
    return scale(-size / rate if rate > 0.0 else 0.0, spin)


def rolling_heat(touch: Touch, load: ContactLoad, dt: float, own_spin: bool, before: Vec) -> float:
    """Return the heat of rolling in J since the forces before, when the torque on i was ``before``."""
    if own_spin:
        return -dt * (dot(load.torque_i, touch.spin_i) + dot(load.torque_j, touch.spin_j))
    return 0.5 * dot(add(load.torque_i, before), touch.turned)
