"""One bond in its lane: gather the motion of the ends, apply kinematics and law, scatter the loads."""

from __future__ import annotations

from clast.engine.compiler import inlined
from clast.engine.state import Floats, Particles
from clast.maths.rotation import IDENTITY
from clast.maths.vec3 import ZERO, dot, scale, sub
from clast.parts.bond_kinematics import BondMotion, EndLoads
from clast.parts.bond_model import BondLoad

from .bond_dashpots import damped
from .images import box_of, image_velocity, nearest
from .lanes import put, vector
from .layout import (
    BOND_D,
    BOND_F,
    BOND_MI,
    BOND_MJ,
    BOND_QI,
    BOND_QJ,
    BOND_V,
    BOND_WI,
    BOND_WJ,
    FLOWED,
    INDEX,
    LANES,
    OVERLOAD,
    RATE_V,
    RATE_WI,
    RATE_WJ,
    F,
    M,
    Q,
    V,
    W,
    X,
)
from .rows import add_to_row, own_ends, take_from_row
from .slots import (
    BOND_DAMPING,
    BOND_EVENTS,
    BOND_FLOW,
    BOND_LIMIT,
    BOND_ORIENTATION,
    BOND_VELOCITY,
    FADE,
    LEDGER,
    PERIODIC,
    STRETCHES,
    bond_beyond,
    bond_end_loads,
    bond_energy,
    bond_failure,
    bond_flow,
    bond_load,
    bond_measure,
    bond_overload,
    read_bond_state,
    read_constants,
    read_kinematic_state,
    read_reference,
    write_bond_state,
    write_kinematic_state,
)


@inlined
def gather(particles: Particles, i: int, j: int, scratch: Floats, lane: int) -> None:
    """Copy what the kinematics needs of the ends into the scratch table."""
    pose, twist, seen = particles.pose, particles.twist, particles.seen
    for c in range(3):
        scratch[(BOND_D + c) * LANES + lane] = pose[j, X + c] - pose[i, X + c]
    if PERIODIC:
        put(scratch, BOND_D, lane, nearest(box_of(particles), vector(scratch, BOND_D, lane)))
    if BOND_ORIENTATION:
        for c in range(4):
            scratch[(BOND_QI + c) * LANES + lane] = pose[i, Q + c]
            scratch[(BOND_QJ + c) * LANES + lane] = pose[j, Q + c]
    if BOND_VELOCITY:  # with these the ends moved since the forces before, whatever velocity the forces see
        for c in range(3):
            scratch[(BOND_V + c) * LANES + lane] = twist[j, V + c] - twist[i, V + c]
            scratch[(BOND_WI + c) * LANES + lane] = twist[i, W + c]
            scratch[(BOND_WJ + c) * LANES + lane] = twist[j, W + c]
    if BOND_DAMPING:
        for c in range(3):
            scratch[(RATE_V + c) * LANES + lane] = seen[j, V + c] - seen[i, V + c]
            scratch[(RATE_WI + c) * LANES + lane] = seen[i, W + c]
            scratch[(RATE_WJ + c) * LANES + lane] = seen[j, W + c]
    if STRETCHES:
        see_image_move(particles, i, j, scratch, lane)


@inlined
def see_image_move(particles: Particles, i: int, j: int, scratch: Floats, lane: int) -> None:
    """Add to the velocities in a lane that of the image that the second end is, in a box that is stretched."""
    away = image_velocity(particles, i, j)
    for c in range(3):
        if BOND_VELOCITY:
            scratch[(BOND_V + c) * LANES + lane] += away[c]
        if BOND_DAMPING:
            scratch[(RATE_V + c) * LANES + lane] += away[c]


@inlined
def read_motion(scratch: Floats, lane: int) -> BondMotion:
    """Return the motion of the ends of a lane's bond."""
    q_i, q_j = IDENTITY, IDENTITY
    v, w_i, w_j = ZERO, ZERO, ZERO
    if BOND_ORIENTATION:
        a, b = vector(scratch, BOND_QI + 1, lane), vector(scratch, BOND_QJ + 1, lane)
        q_i = (scratch[BOND_QI * LANES + lane], a[0], a[1], a[2])
        q_j = (scratch[BOND_QJ * LANES + lane], b[0], b[1], b[2])
    if BOND_VELOCITY:
        v = vector(scratch, BOND_V, lane)
        w_i = vector(scratch, BOND_WI, lane)
        w_j = vector(scratch, BOND_WJ, lane)
    return BondMotion(vector(scratch, BOND_D, lane), q_i, q_j, v, w_i, w_j)


@inlined
def bond_lane(scratch: Floats, data: Floats, lane: int, uniforms: tuple[float, ...], dt: float) -> None:
    """Compute the bond of one lane: loads on its ends, new state, failure index, overload."""
    motion = read_motion(scratch, lane)
    strain, frame, kinematic_state = bond_measure(
        motion, read_reference(data, lane), read_kinematic_state(data, lane), dt
    )
    constants = read_constants(uniforms, data, lane)
    before = read_bond_state(data, lane)
    state = bond_flow(strain, constants, before)
    load = bond_load(strain, constants, state)
    ends = bond_end_loads(load, frame)
    if BOND_DAMPING:
        ends = damped(ends, motion.d, scratch, data, lane)
    if BOND_FLOW and LEDGER:
        freed = bond_energy(strain, constants, before) - bond_energy(strain, constants, state)
        slack = lessened(bond_load(strain, constants, before), load)
        scratch[FLOWED * LANES + lane] = freed - 0.5 * work_of(bond_end_loads(slack, frame), scratch, lane, dt)
    write_kinematic_state(data, lane, kinematic_state)
    if BOND_FLOW:
        write_bond_state(data, lane, state)
    index = bond_failure(strain, load, constants, state)
    if BOND_LIMIT:
        index = 1.0 if bond_beyond(motion) else index
    data[INDEX * LANES + lane] = index
    if BOND_EVENTS:
        scratch[OVERLOAD * LANES + lane] = bond_overload(strain, constants, state)
    put(scratch, BOND_F, lane, ends.force)
    put(scratch, BOND_MI, lane, ends.moment_i)
    put(scratch, BOND_MJ, lane, ends.moment_j)


@inlined
def lessened(load: BondLoad, by: BondLoad) -> BondLoad:
    """Return the difference of two loads."""
    return BondLoad(
        load.normal - by.normal, sub(load.shear, by.shear), load.torsion - by.torsion, sub(load.bending, by.bending)
    )


@inlined
def work_of(ends: EndLoads, scratch: Floats, lane: int, dt: float) -> float:
    """Return the work that loads as they are now took from the ends since the forces before, in J."""
    moved, turned_i, turned_j = (
        vector(scratch, BOND_V, lane),
        vector(scratch, BOND_WI, lane),
        vector(scratch, BOND_WJ, lane),
    )
    return -dt * (dot(ends.force, moved) + dot(ends.moment_i, turned_i) + dot(ends.moment_j, turned_j))


@inlined
def scatter(particles: Particles, i: int, j: int, sides: int, scratch: Floats, lane: int, share: float) -> None:
    """Add a lane's loads to those of its ends that belong to the chunk."""
    load = particles.load
    force = vector(scratch, BOND_F, lane)
    moment_i, moment_j = vector(scratch, BOND_MI, lane), vector(scratch, BOND_MJ, lane)
    if FADE:
        force, moment_i, moment_j = scale(share, force), scale(share, moment_i), scale(share, moment_j)
    own_i, own_j = own_ends(sides)
    take_from_row(load, i, F, force, own_i)
    add_to_row(load, i, M, moment_i, own_i)
    add_to_row(load, j, F, force, own_j)
    add_to_row(load, j, M, moment_j, own_j)
