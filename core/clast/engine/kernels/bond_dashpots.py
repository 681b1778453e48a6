"""Dashpots beside bonds: their loads, and the heat that they take up."""

from __future__ import annotations

from clast.engine.compiler import inlined
from clast.engine.state import Floats, Particles
from clast.maths.vec3 import across, add, along, cross, dot, norm, scale, sub
from clast.parts.bond_kinematics import EndLoads

from .images import velocity_between
from .lanes import put, row, vector
from .layout import BOND_D, DRAG_F, DRAG_M, RATE_V, RATE_WI, RATE_WJ, W
from .slots import BOND_BOOKS, BOND_DRAG, read_damping


@inlined
def damped(ends: EndLoads, d: tuple[float, float, float], scratch: Floats, data: Floats, lane: int) -> EndLoads:
    """Add the dashpots of stretching, shearing, twisting and bending, which rigid motion does not move."""
    c_n, c_t, c_tor, c_b = read_damping(data, lane)
    w_i, w_j = vector(scratch, RATE_WI, lane), vector(scratch, RATE_WJ, lane)
    n = scale(1.0 / norm(d), d)
    slip = sub(vector(scratch, RATE_V, lane), cross(scale(0.5, add(w_i, w_j)), d))
    turn_rate = sub(w_j, w_i)
    pull = add(scale(c_n, along(slip, n)), scale(c_t, across(slip, n)))
    moment = add(scale(c_tor, along(turn_rate, n)), scale(c_b, across(turn_rate, n)))
    lever = scale(0.5, cross(d, pull))
    if BOND_BOOKS:
        put(scratch, DRAG_F, lane, pull)
        put(scratch, DRAG_M, lane, moment)
    return EndLoads(
        sub(ends.force, pull),
        add(ends.moment_i, add(lever, moment)),
        add(ends.moment_j, sub(lever, moment)),
    )


@inlined
def dashpot_heat(
    particles: Particles, i: int, j: int, scratch: Floats, data: Floats, lane: int, share: float, dt: float
) -> float:
    """Return what a lane's dashpots took up since the forces before; keep their loads until the next.

    The mean of the loads then and now, times the way between. Power times the step would not do where a bond lets go or
    its stress drops: the velocity at which dashpots act then is not the mean of those before and after.
    """
    twist = particles.twist
    w_i, w_j = row(twist, i, W), row(twist, j, W)
    moved = scale(dt, velocity_between(particles, twist, i, j))
    middle = sub(vector(scratch, BOND_D, lane), scale(0.5, moved))
    slip = sub(moved, cross(scale(0.5 * dt, add(w_i, w_j)), middle))
    turn = scale(dt, sub(w_j, w_i))
    pull, moment = scale(share, vector(scratch, DRAG_F, lane)), scale(share, vector(scratch, DRAG_M, lane))
    forces, moments = add(pull, vector(data, BOND_DRAG, lane)), add(moment, vector(data, BOND_DRAG + 3, lane))
    put(data, BOND_DRAG, lane, pull)
    put(data, BOND_DRAG + 3, lane, moment)
    return 0.5 * (dot(forces, slip) + dot(moments, turn))
