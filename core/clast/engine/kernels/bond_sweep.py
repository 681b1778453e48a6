"""Bonds, in blocks of lanes: gather the motion of the ends, apply kinematics and law, scatter the loads."""

from __future__ import annotations

from clast.engine.compiler import inlined, routine
from clast.engine.state import Bonds, Cracks, Floats, Numbers, Particles
from clast.maths.rotation import IDENTITY
from clast.maths.vec3 import ZERO, across, add, along, cross, norm, scale, sub
from clast.parts.bond_kinematics import BondMotion, EndLoads
from clast.parts.bond_model import RandomKey

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
    FIRST,
    INDEX,
    INTACT,
    LANES,
    OVERLOAD,
    SECOND,
    F,
    M,
    Q,
    V,
    W,
    X,
)
from .slots import (
    BOND_DAMPING,
    BOND_EVENTS,
    BOND_FLOW,
    BOND_ORIENTATION,
    BOND_VELOCITY,
    CHUNKED,
    FADE,
    bond_end_loads,
    bond_energy,
    bond_failure,
    bond_flow,
    bond_load,
    bond_measure,
    bond_mode,
    bond_on_event,
    bond_overload,
    read_bond_state,
    read_constants,
    read_damping,
    read_kinematic_state,
    read_reference,
    read_uniforms,
    write_bond_state,
    write_kinematic_state,
)

MOST_EVENTS = 100_000


@inlined
def gather(particles: Particles, i: int, j: int, scratch: Floats, lane: int) -> None:
    """Copy what the kinematics needs of the ends into the scratch table."""
    pose, seen = particles.pose, particles.seen
    for c in range(3):
        scratch[(BOND_D + c) * LANES + lane] = pose[j, X + c] - pose[i, X + c]
    if BOND_ORIENTATION:
        for c in range(4):
            scratch[(BOND_QI + c) * LANES + lane] = pose[i, Q + c]
            scratch[(BOND_QJ + c) * LANES + lane] = pose[j, Q + c]
    if BOND_VELOCITY:
        for c in range(3):
            scratch[(BOND_V + c) * LANES + lane] = seen[j, V + c] - seen[i, V + c]
            scratch[(BOND_WI + c) * LANES + lane] = seen[i, W + c]
            scratch[(BOND_WJ + c) * LANES + lane] = seen[j, W + c]


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
def damped(ends: EndLoads, motion: BondMotion, data: Floats, lane: int) -> EndLoads:
    """Add the dashpots of stretching, shearing, twisting and bending; rigid motion costs nothing."""
    c_n, c_t, c_tor, c_b = read_damping(data, lane)
    n = scale(1.0 / norm(motion.d), motion.d)
    slip = sub(motion.v, cross(scale(0.5, add(motion.w_i, motion.w_j)), motion.d))
    turn = sub(motion.w_j, motion.w_i)
    pull = add(scale(c_n, along(slip, n)), scale(c_t, across(slip, n)))
    moment = add(scale(c_tor, along(turn, n)), scale(c_b, across(turn, n)))
    lever = scale(0.5, cross(motion.d, pull))
    return EndLoads(
        sub(ends.force, pull),
        add(ends.moment_i, add(lever, moment)),
        add(ends.moment_j, sub(lever, moment)),
    )


@inlined
def bond_lane(scratch: Floats, data: Floats, lane: int, uniforms: tuple[float, ...], dt: float) -> None:
    """Compute the bond of one lane: loads on its ends, new state, failure index, overload."""
    motion = read_motion(scratch, lane)
    strain, frame, kinematic_state = bond_measure(
        motion, read_reference(data, lane), read_kinematic_state(data, lane), dt
    )
    constants = read_constants(uniforms, data, lane)
    state = bond_flow(strain, constants, read_bond_state(data, lane))
    load = bond_load(strain, constants, state)
    ends = bond_end_loads(load, frame)
    if BOND_DAMPING:
        ends = damped(ends, motion, data, lane)
    write_kinematic_state(data, lane, kinematic_state)
    if BOND_FLOW:
        write_bond_state(data, lane, state)
    data[INDEX * LANES + lane] = bond_failure(strain, load, constants, state)
    if BOND_EVENTS:
        scratch[OVERLOAD * LANES + lane] = bond_overload(strain, constants, state)
    put(scratch, BOND_F, lane, ends.force)
    put(scratch, BOND_MI, lane, ends.moment_i)
    put(scratch, BOND_MJ, lane, ends.moment_j)


@routine
def settle_events(scratch: Floats, data: Floats, lane: int, uniforms: tuple[float, ...], key: RandomKey) -> None:
    """Carry out the discrete events that are due in one lane, then compute its loads again."""
    strain, _, _ = bond_measure(
        read_motion(scratch, lane), read_reference(data, lane), read_kinematic_state(data, lane), 0.0
    )
    constants = read_constants(uniforms, data, lane)
    state = read_bond_state(data, lane)
    for _ in range(MOST_EVENTS):
        if not bond_overload(strain, constants, state) > 1.0:
            break
        state = bond_on_event(strain, constants, state, key)
    write_bond_state(data, lane, state)
    bond_lane(scratch, data, lane, uniforms, 0.0)


@routine
def log_crack(
    cracks: Cracks,
    chunk: int,
    particles: Particles,
    i: int,
    j: int,
    scratch: Floats,
    data: Floats,
    lane: int,
    uniforms: tuple[float, ...],
    bond: int,
    step: int,
) -> None:
    """Write the breaking of one lane's bond into the crack table."""
    strain, _, _ = bond_measure(
        read_motion(scratch, lane), read_reference(data, lane), read_kinematic_state(data, lane), 0.0
    )
    constants = read_constants(uniforms, data, lane)
    state = read_bond_state(data, lane)
    load = bond_load(strain, constants, state)
    row = cracks.begin[chunk] + cracks.filled[chunk]
    cracks.filled[chunk] += 1
    cracks.step[row] = step
    cracks.bond[row] = bond
    cracks.ends[row, 0] = i
    cracks.ends[row, 1] = j
    for c in range(3):
        cracks.position[row, c] = 0.5 * (particles.pose[i, X + c] + particles.pose[j, X + c])
    cracks.mode[row] = bond_mode(strain, load, constants, state)
    cracks.load[row, 0] = load.normal
    cracks.load[row, 1] = norm(load.shear)
    cracks.load[row, 2] = bond_energy(strain, constants, state)


@inlined
def scatter(particles: Particles, i: int, j: int, sides: int, scratch: Floats, lane: int, share: float) -> None:
    """Add a lane's loads to those of its ends that belong to the chunk."""
    load = particles.load
    for c in range(3):
        force = scratch[(BOND_F + c) * LANES + lane]
        moment_i = scratch[(BOND_MI + c) * LANES + lane]
        moment_j = scratch[(BOND_MJ + c) * LANES + lane]
        if FADE:
            force, moment_i, moment_j = share * force, share * moment_i, share * moment_j
        if not CHUNKED or sides & FIRST:
            load[i, F + c] -= force
            load[i, M + c] += moment_i
        if not CHUNKED or sides & SECOND:
            load[j, F + c] += force
            load[j, M + c] += moment_j


@routine
def sweep_bonds(
    bonds: Bonds,
    chunk: int,
    particles: Particles,
    cracks: Cracks,
    numbers: Numbers,
    scratch: Floats,
    dt: float,
    step: int,
) -> None:
    """Add the loads of a chunk's bonds to its particles; break what fails."""
    uniforms = read_uniforms(numbers.bond_uniforms)
    for b in range(bonds.begin[chunk], bonds.begin[chunk + 1]):
        first, second, sides, data = bonds.first[b], bonds.second[b], bonds.sides[b], bonds.data[b]
        for lane in range(LANES):
            gather(particles, first[lane], second[lane], scratch, lane)
        for lane in range(LANES):
            bond_lane(scratch, data, lane, uniforms, dt)
        for lane in range(LANES):
            share = data[INTACT * LANES + lane]
            if share == 0.0:
                continue
            i, j = first[lane], second[lane]
            if BOND_EVENTS and scratch[OVERLOAD * LANES + lane] > 1.0 and data[INDEX * LANES + lane] < 1.0:
                settle_events(scratch, data, lane, uniforms, RandomKey(numbers.seed, bonds.number[b, lane]))
            if data[INDEX * LANES + lane] >= 1.0 or share < 1.0:
                if share == 1.0 and (not CHUNKED or sides[lane] & FIRST):
                    number = bonds.number[b, lane]
                    log_crack(cracks, chunk, particles, i, j, scratch, data, lane, uniforms, number, step)
                share = max(share - numbers.fade, 0.0)
                data[INTACT * LANES + lane] = share
                if share == 0.0:
                    continue
            scatter(particles, i, j, sides[lane], scratch, lane, share)
