"""Contacts between particles: find the touching pairs, gather them into lanes, apply the law, scatter the loads."""

from __future__ import annotations

from math import sqrt
from typing import Any

from clast.engine.compiler import inlined, routine
from clast.engine.state import Bonds, Floats, Indices, Numbers, Pairs, Particles
from clast.maths.vec3 import ZERO, add, cross, dot, scale, sub
from clast.parts.contact_law import Touch

from .lanes import put, row, vector
from .layout import (
    CONTACT_F,
    CONTACT_FREE,
    CONTACT_MI,
    CONTACT_MJ,
    DRAG,
    DRIFT,
    DV,
    FIRST,
    II,
    IM,
    INTACT,
    INVERSE_INERTIA,
    INVERSE_MASS,
    LANES,
    LOST,
    MATERIAL,
    NORMAL,
    RADIUS,
    REST,
    RI,
    RJ,
    SECOND,
    TURNED,
    TURNING,
    VISCOUS,
    WI,
    WJ,
    D,
    F,
    M,
    V,
    W,
    X,
)
from .slots import (
    BONDED_PAIRS_TOUCH,
    CHOICES,
    CHUNKED,
    CONTACT_CONSTANTS,
    CONTACT_LOSSES,
    HISTORY,
    ONE_MATERIAL,
    REMEMBERS,
    RESTS,
    ROLLS,
    SPIN,
    VELOCITY_FORCES,
    carry_history,
    contact_load,
    contact_losses,
    read_contact_constants,
    read_history,
    row_constants,
    write_history,
)
from .touching import share_since_touch

HISTORY_BASE = CONTACT_FREE + (0 if ONE_MATERIAL else CONTACT_CONSTANTS)


@inlined
def gather(particles: Particles, pairs: Pairs, k: int, numbers: Numbers, scratch: Floats, lane: int) -> None:
    """Copy what else the law needs of pair k into a lane."""
    seen, body = particles.seen, particles.body
    i, j = pairs.first[k], pairs.second[k]
    if VELOCITY_FORCES:
        scratch[IM * LANES + lane] = body[i, INVERSE_MASS] + body[j, INVERSE_MASS]
        for c in range(3):
            scratch[(DV + c) * LANES + lane] = seen[j, V + c] - seen[i, V + c]
    if SPIN:
        scratch[II * LANES + lane] = body[i, INVERSE_INERTIA] + body[j, INVERSE_INERTIA]
        for c in range(3):
            scratch[(WI + c) * LANES + lane] = seen[i, W + c]
            scratch[(WJ + c) * LANES + lane] = seen[j, W + c]
    if not ONE_MATERIAL:
        row = numbers.contact_table[int(body[i, MATERIAL]), int(body[j, MATERIAL])]
        for c in range(CONTACT_CONSTANTS):
            scratch[(CONTACT_FREE + c) * LANES + lane] = row[c]
    if REMEMBERS:
        pose, twist = particles.pose, particles.twist
        for c in range(3):
            scratch[(DRIFT + c) * LANES + lane] = twist[j, V + c] - twist[i, V + c]
            scratch[(TURNING + c) * LANES + lane] = (
                pose[i, RADIUS] * twist[i, W + c] + pose[j, RADIUS] * twist[j, W + c]
            )
    if HISTORY > 0:
        known = pairs.touching[k] != 0
        for c in range(3):
            scratch[(NORMAL + c) * LANES + lane] = pairs.history[k, c] if known else 0.0
        for c in range(HISTORY):
            scratch[(HISTORY_BASE + c) * LANES + lane] = pairs.history[k, 3 + c] if known else 0.0
    if CONTACT_LOSSES:
        known = pairs.touching[k] != 0
        for c in range(3):
            if ROLLS:
                scratch[(TURNED + c) * LANES + lane] = particles.twist[j, W + c] - particles.twist[i, W + c]
            scratch[(DRAG + c) * LANES + lane] = pairs.history[k, 3 + HISTORY + c] if known else 0.0


@inlined
def read_touch(scratch: Floats, lane: int, dt: float, at_contact_point: float) -> tuple[Touch, float, float, float]:
    """Return the contact of a lane, the lever arms of its force, and the share of the way that came after touch."""
    d = vector(scratch, D, lane)
    r_i, r_j = scratch[RI * LANES + lane], scratch[RJ * LANES + lane]
    distance = sqrt(dot(d, d))
    n = scale(1.0 / distance, d)
    overlap = r_i + r_j - distance
    share = 1.0 / (r_i + r_j)
    lever = 1.0 - at_contact_point * overlap * share  # as a share of the radius
    lever_i, lever_j = lever * r_i, lever * r_j
    if RESTS:
        overlap = overlap - scratch[REST * LANES + lane]
    velocity, w_i, w_j, per_mass, per_inertia = ZERO, ZERO, ZERO, 1.0, 1.0
    if VELOCITY_FORCES:
        velocity = vector(scratch, DV, lane)
        per_mass = scratch[IM * LANES + lane]
    if SPIN:
        w_i, w_j = vector(scratch, WI, lane), vector(scratch, WJ, lane)
        velocity = sub(velocity, cross(add(scale(lever_i, w_i), scale(lever_j, w_j)), n))
        per_inertia = scratch[II * LANES + lane]
    moved, share_moved = ZERO, 1.0
    if REMEMBERS:
        rolled = cross(scale(lever, vector(scratch, TURNING, lane)), n)
        moved = scale(dt, sub(vector(scratch, DRIFT, lane), rolled))
        share_moved = share_since_touch(moved, n, overlap)
        moved = scale(share_moved, moved)
    turned = scale(dt, vector(scratch, TURNED, lane)) if CONTACT_LOSSES and ROLLS else ZERO
    touch = Touch(overlap, n, velocity, w_i, w_j, r_i * r_j * share, r_i, r_j, per_mass, per_inertia, moved, turned)
    return touch, lever_i, lever_j, share_moved


@inlined
def contact_lane(scratch: Floats, lane: int, shared: Any, dt: float, at_contact_point: float) -> None:
    """Compute the contact of one lane: force on j, moments on both, new history."""
    touch, lever_i, lever_j, share_moved = read_touch(scratch, lane, dt, at_contact_point)
    n = touch.normal
    constants = shared if ONE_MATERIAL else read_contact_constants(scratch, CONTACT_FREE, lane)
    history = read_history(scratch, HISTORY_BASE, lane)
    if HISTORY > 0:
        spin = 0.5 * (dot(touch.spin_i, n) + dot(touch.spin_j, n)) * dt
        history = carry_history(history, vector(scratch, NORMAL, lane), n, spin)
    load, kept = contact_load(touch, constants, history, dt, CHOICES)
    put(scratch, CONTACT_F, lane, load.force)
    if SPIN:
        arm = cross(n, load.force)
        put(scratch, CONTACT_MI, lane, sub(load.torque_i, scale(lever_i, arm)))
        put(scratch, CONTACT_MJ, lane, sub(load.torque_j, scale(lever_j, arm)))
    if HISTORY > 0:
        put(scratch, NORMAL, lane, n)
        write_history(scratch, HISTORY_BASE, lane, kept)
    if CONTACT_LOSSES:
        lost = contact_losses(touch, constants, history, load, kept, dt, CHOICES, vector(scratch, DRAG, lane))
        scratch[LOST * LANES + lane] = lost.viscous / share_moved  # drag acts all the way that the step is long
        scratch[(LOST + 1) * LANES + lane] = lost.sliding
        scratch[(LOST + 2) * LANES + lane] = lost.rolling
        scratch[(LOST + 3) * LANES + lane] = lost.stiffening
        put(scratch, DRAG, lane, lost.drag)


@inlined
def scatter(particles: Particles, pairs: Pairs, k: int, scratch: Floats, lane: int, book: Floats) -> None:
    """Add a lane's loads to those of its particles that belong to the chunk, keep its history, book its losses."""
    load, sides = particles.load, pairs.sides[k]
    i, j = pairs.first[k], pairs.second[k]
    for c in range(3):
        force = scratch[(CONTACT_F + c) * LANES + lane]
        if not CHUNKED or sides & FIRST:
            load[i, F + c] -= force
            if SPIN:
                load[i, M + c] += scratch[(CONTACT_MI + c) * LANES + lane]
        if not CHUNKED or sides & SECOND:
            load[j, F + c] += force
            if SPIN:
                load[j, M + c] += scratch[(CONTACT_MJ + c) * LANES + lane]
    if HISTORY > 0:
        for c in range(3):
            pairs.history[k, c] = scratch[(NORMAL + c) * LANES + lane]
        for c in range(HISTORY):
            pairs.history[k, 3 + c] = scratch[(HISTORY_BASE + c) * LANES + lane]
    if CONTACT_LOSSES:
        for c in range(3):
            pairs.history[k, 3 + HISTORY + c] = scratch[(DRAG + c) * LANES + lane]
        if sides & FIRST:
            for term in range(4):
                book[term] += scratch[(LOST + term) * LANES + lane]
    if REMEMBERS:
        pairs.touching[k] = 1


@inlined
def meet(particles: Particles, pairs: Pairs, k: int, scratch: Floats, lane: int) -> bool:
    """Copy the distance and the radii of pair k into a lane; tell whether the particles touch."""
    pose = particles.pose
    i, j = pairs.first[k], pairs.second[k]
    d = (pose[j, X] - pose[i, X], pose[j, X + 1] - pose[i, X + 1], pose[j, X + 2] - pose[i, X + 2])
    r_i, r_j = pose[i, RADIUS], pose[j, RADIUS]
    put(scratch, D, lane, d)
    scratch[RI * LANES + lane] = r_i
    scratch[RJ * LANES + lane] = r_j
    reach = r_i + r_j
    if RESTS:
        scratch[REST * LANES + lane] = pairs.rest[k]
        reach -= pairs.rest[k]
    return not dot(d, d) >= reach * reach


@inlined
def parting_loss(particles: Particles, pairs: Pairs, k: int, dt: float) -> float:
    """Return what the drag of the last evaluation still takes up while pair k comes apart."""
    twist, last = particles.twist, row(pairs.history, k, 3 + HISTORY)
    return 0.5 * dt * dot(last, sub(row(twist, pairs.second[k], V), row(twist, pairs.first[k], V)))


@inlined
def joined(pairs: Pairs, bonds: Bonds, k: int) -> bool:
    """Tell whether an intact bond stands in for the contact of pair k."""
    place = pairs.bond[k]
    return place >= 0 and bool(bonds.data[place // LANES, INTACT * LANES + place % LANES] == 1.0)


@routine
def apply(
    particles: Particles,
    pairs: Pairs,
    active: Indices,
    count: int,
    numbers: Numbers,
    scratch: Floats,
    book: Floats,
    dt: float,
) -> None:
    """Gather, compute and scatter one block of touching pairs."""
    for lane in range(count):
        gather(particles, pairs, active[lane], numbers, scratch, lane)
    material = int(particles.body[0, MATERIAL])
    shared = row_constants(numbers.contact_table[material, material])
    for lane in range(LANES):  # always all: a loop of fixed length vectorises
        contact_lane(scratch, lane, shared, dt, numbers.lever)
    for lane in range(count):
        scatter(particles, pairs, active[lane], scratch, lane, book)


@routine
def sweep_contacts(
    pairs: Pairs,
    chunk: int,
    bonds: Bonds,
    particles: Particles,
    numbers: Numbers,
    scratch: Floats,
    active: Indices,
    book: Floats,
    dt: float,
) -> None:
    """Add the loads of a chunk's touching pairs to its particles, in the order of the pairs; book their losses."""
    count = 0
    for k in range(pairs.begin[chunk], pairs.begin[chunk + 1]):
        if not meet(particles, pairs, k, scratch, count):
            if REMEMBERS and pairs.touching[k] != 0:
                pairs.touching[k] = 0
                if CONTACT_LOSSES and pairs.sides[k] & FIRST:
                    book[VISCOUS] += parting_loss(particles, pairs, k, dt)
            continue
        if not BONDED_PAIRS_TOUCH and joined(pairs, bonds, k):
            continue
        active[count] = k
        count += 1
        if count == LANES:
            apply(particles, pairs, active, count, numbers, scratch, book, dt)
            count = 0
    if count > 0:
        apply(particles, pairs, active, count, numbers, scratch, book, dt)
