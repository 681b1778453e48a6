"""What happens to single bonds: drops, breaking, and the energy each sets free."""

from __future__ import annotations

from clast.engine.compiler import inlined, routine
from clast.engine.state import Cracks, Floats, Particles
from clast.maths.rotation import IDENTITY, turn
from clast.maths.vec3 import norm, scale, sub
from clast.parts.bond_kinematics import BondMotion
from clast.parts.bond_model import RandomKey, Strain

from .bond_lane import bond_lane, read_motion
from .images import velocity_between, way_between
from .lanes import row
from .layout import Q, W, X
from .slots import (
    BOND_LIMIT,
    BOND_ORIENTATION,
    LEDGER,
    PERIODIC,
    TURNED_MODE,
    bond_beyond,
    bond_energy,
    bond_load,
    bond_measure,
    bond_mode,
    bond_on_event,
    bond_overload,
    read_bond_state,
    read_constants,
    read_kinematic_state,
    read_reference,
    write_bond_state,
)

MOST_EVENTS = 100_000


@inlined
def strain_before(particles: Particles, i: int, j: int, data: Floats, lane: int, time: float) -> Strain:
    """Return the strain some time ago, no longer than the last two force evaluations are apart."""
    pose, twist = particles.pose, particles.twist
    q_i, q_j = IDENTITY, IDENTITY
    if BOND_ORIENTATION:
        q_i = turn(quaternion(pose, i), row(twist, i, W), -time)
        q_j = turn(quaternion(pose, j), row(twist, j, W), -time)
    d, v = way_between(particles, i, j), velocity_between(particles, twist, i, j)
    motion = BondMotion(sub(d, scale(time, v)), q_i, q_j, v, row(twist, i, W), row(twist, j, W))
    strain: Strain = bond_measure(motion, read_reference(data, lane), read_kinematic_state(data, lane), -time)[0]
    return strain


@inlined
def quaternion(pose: Floats, k: int) -> tuple[float, float, float, float]:
    """Return the orientation of particle k."""
    return (pose[k, Q], pose[k, Q + 1], pose[k, Q + 2], pose[k, Q + 3])


@inlined
def stored(strain: Strain, data: Floats, lane: int, uniforms: tuple[float, ...]) -> float:
    """Return the elastic energy of a lane's bond at a strain, in J."""
    energy: float = bond_energy(strain, read_constants(uniforms, data, lane), read_bond_state(data, lane))
    return energy


@routine
def let_go(
    particles: Particles, i: int, j: int, data: Floats, lane: int, uniforms: tuple[float, ...], dt: float
) -> float:
    """Return the energy that a bond held when it broke, at some time between the last two force evaluations, in J.

    What it held at the former, and half the work it would have done on the way to the latter: for a linear bond ½ k
    times the elongations at both.
    """
    half_way = stored(strain_before(particles, i, j, data, lane, 0.5 * dt), data, lane, uniforms)
    then = stored(strain_before(particles, i, j, data, lane, dt), data, lane, uniforms)
    now = stored(strain_before(particles, i, j, data, lane, 0.0), data, lane, uniforms)
    return 2.0 * half_way - 0.5 * (then + now)


@routine
def settle_events(
    particles: Particles,
    i: int,
    j: int,
    scratch: Floats,
    data: Floats,
    lane: int,
    uniforms: tuple[float, ...],
    key: RandomKey,
    dt: float,
) -> float:
    """Carry out the discrete events that are due in one lane, compute its loads again; return the energy set free.

    Events happen, on average, half-way between the last two force evaluations: what counts is the energy there.
    """
    strain, _, _ = bond_measure(
        read_motion(scratch, lane), read_reference(data, lane), read_kinematic_state(data, lane), 0.0
    )
    constants = read_constants(uniforms, data, lane)
    before = read_bond_state(data, lane)
    state = before
    for _ in range(MOST_EVENTS):
        if not bond_overload(strain, constants, state) > 1.0:
            break
        state = bond_on_event(strain, constants, state, key)
    write_bond_state(data, lane, state)
    bond_lane(scratch, data, lane, uniforms, 0.0)
    if LEDGER:
        half_way = strain_before(particles, i, j, data, lane, 0.5 * dt)
        freed: float = bond_energy(half_way, constants, before) - bond_energy(half_way, constants, state)
        return freed
    return 0.0


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
    motion = read_motion(scratch, lane)
    strain, _, _ = bond_measure(motion, read_reference(data, lane), read_kinematic_state(data, lane), 0.0)
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
        if PERIODIC:
            cracks.position[row, c] = particles.pose[i, X + c] + 0.5 * motion.d[c]
        else:
            cracks.position[row, c] = 0.5 * (particles.pose[i, X + c] + particles.pose[j, X + c])
    cracks.mode[row] = bond_mode(strain, load, constants, state)
    if BOND_LIMIT:
        cracks.mode[row] = TURNED_MODE if bond_beyond(motion) else cracks.mode[row]
    cracks.load[row, 0] = load.normal
    cracks.load[row, 1] = norm(load.shear)
    cracks.load[row, 2] = bond_energy(strain, constants, state)
