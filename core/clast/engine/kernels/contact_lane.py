"""The contact of one lane: gather what the law needs, apply it, scatter its loads."""

from __future__ import annotations

from math import sqrt
from typing import Any

from clast.engine.compiler import inlined
from clast.engine.state import Floats, Numbers, Pairs, Particles
from clast.maths.vec3 import ZERO, add, cross, dot, scale, sub
from clast.parts.contact_law import Drag, Touch

from .images import image_velocity
from .lanes import put, row, vector
from .layout import (
    BOX_POWER,
    CONTACT_F,
    CONTACT_FREE,
    CONTACT_MI,
    CONTACT_MJ,
    DRAG,
    DRIFT,
    DV,
    FIRST,
    HELD,
    II,
    IM,
    INVERSE_INERTIA,
    INVERSE_MASS,
    LANES,
    LOST,
    MATERIAL,
    NORMAL,
    PLASTIC,
    RADIUS,
    REST,
    RI,
    RJ,
    TURNED,
    TURNING,
    WI,
    WJ,
    D,
    F,
    M,
    V,
    W,
)
from .parting import jump_at_touch
from .rows import add_to_row, own_ends, take_from_row
from .slots import (
    CHOICES,
    CONTACT_CONSTANTS,
    CONTACT_LOSSES,
    HISTORY,
    ONE_MATERIAL,
    ONE_SIZE,
    REACHES,
    REMEMBERS,
    RESTS,
    ROLLS,
    SPIN,
    STRETCHES,
    TURNS,
    VELOCITY_FORCES,
    YIELDS,
    carry_history,
    contact_load,
    contact_losses,
    read_contact_constants,
    read_history,
    write_history,
)
from .touching import share_since_touch

HISTORY_BASE = CONTACT_FREE + (0 if ONE_MATERIAL else CONTACT_CONSTANTS)
DRAG_NUMBERS = (6 if ROLLS else 3) if CONTACT_LOSSES else 0
"""Numbers of a contact's drag that are kept until the next force evaluation, behind its history."""
ROUNDING = 2.0**-52
"""Least overlap as a share of both radii together: what touches by rounding alone, as accepted overlaps do at the
start, still overlaps, as laws are promised."""


@inlined
def radii(particles: Particles, i: int, j: int, numbers: Numbers) -> tuple[float, float]:
    """Return the radii of two particles."""
    if ONE_SIZE:
        return numbers.radius, numbers.radius
    return particles.pose[i, RADIUS], particles.pose[j, RADIUS]


@inlined
def gather(particles: Particles, pairs: Pairs, k: int, numbers: Numbers, scratch: Floats, lane: int) -> None:
    """Copy what else the law needs of pair k into a lane."""
    seen, body = particles.seen, particles.body
    i, j = pairs.first[k], pairs.second[k]
    if VELOCITY_FORCES:
        if not ONE_SIZE:
            scratch[IM * LANES + lane] = body[i, INVERSE_MASS] + body[j, INVERSE_MASS]
        for c in range(3):
            scratch[(DV + c) * LANES + lane] = seen[j, V + c] - seen[i, V + c]
    if SPIN:
        if not ONE_SIZE:
            scratch[II * LANES + lane] = body[i, INVERSE_INERTIA] + body[j, INVERSE_INERTIA]
        for c in range(3):
            scratch[(WI + c) * LANES + lane] = seen[i, W + c]
            scratch[(WJ + c) * LANES + lane] = seen[j, W + c]
    if not ONE_MATERIAL:
        table = numbers.contact_table[int(body[i, MATERIAL]), int(body[j, MATERIAL])]
        for c in range(CONTACT_CONSTANTS):
            scratch[(CONTACT_FREE + c) * LANES + lane] = table[c]
    if REMEMBERS:
        twist, (r_i, r_j) = particles.twist, radii(particles, i, j, numbers)
        for c in range(3):
            scratch[(DRIFT + c) * LANES + lane] = twist[j, V + c] - twist[i, V + c]
            scratch[(TURNING + c) * LANES + lane] = r_i * twist[i, W + c] + r_j * twist[j, W + c]
    if STRETCHES:
        away = image_velocity(particles, i, j)
        for c in range(3):
            if VELOCITY_FORCES:
                scratch[(DV + c) * LANES + lane] += away[c]
            if REMEMBERS:
                scratch[(DRIFT + c) * LANES + lane] += away[c]
    if HISTORY > 0:
        for c in range(3):
            scratch[(NORMAL + c) * LANES + lane] = pairs.history[k, c]
        for c in range(HISTORY):
            scratch[(HISTORY_BASE + c) * LANES + lane] = pairs.history[k, 3 + c]
    if REACHES:
        scratch[HELD * LANES + lane] = pairs.touching[k]
    if TURNS:
        for c in range(3):
            scratch[(TURNED + c) * LANES + lane] = particles.twist[j, W + c] - particles.twist[i, W + c]
    if CONTACT_LOSSES:
        for c in range(DRAG_NUMBERS):
            scratch[(DRAG + c) * LANES + lane] = pairs.history[k, 3 + HISTORY + c]


@inlined
def read_bodies(scratch: Floats, lane: int, numbers: Numbers) -> tuple[float, float, float, float]:
    """Return both radii of a lane's contact, and the sums of inverse masses and of inverse inertias."""
    if ONE_SIZE:
        return numbers.radius, numbers.radius, 2.0 * numbers.inverse_mass, 2.0 * numbers.inverse_inertia
    per_mass = scratch[IM * LANES + lane] if VELOCITY_FORCES else 1.0
    per_inertia = scratch[II * LANES + lane] if SPIN else 1.0
    return scratch[RI * LANES + lane], scratch[RJ * LANES + lane], per_mass, per_inertia


@inlined
def read_touch(scratch: Floats, lane: int, numbers: Numbers, dt: float) -> tuple[Touch, float, float, float]:
    """Return the contact of a lane, the lever arms of its force, and the share of the way that came after touch."""
    d = vector(scratch, D, lane)
    r_i, r_j, per_mass, per_inertia = read_bodies(scratch, lane, numbers)
    distance = sqrt(dot(d, d))
    n = scale(1.0 / distance, d)
    overlap = r_i + r_j - distance
    share = 1.0 / (r_i + r_j)
    lever = 1.0 - numbers.lever * overlap * share  # as a share of the radius
    lever_i, lever_j = lever * r_i, lever * r_j
    if RESTS:
        overlap = overlap - scratch[REST * LANES + lane]
    held = False
    if REACHES:
        held = scratch[HELD * LANES + lane] != 0.0
    if not held:
        overlap = max(overlap, ROUNDING * (r_i + r_j))
    velocity, w_i, w_j = ZERO, ZERO, ZERO
    if VELOCITY_FORCES:
        velocity = vector(scratch, DV, lane)
    if SPIN:
        w_i, w_j = vector(scratch, WI, lane), vector(scratch, WJ, lane)
        velocity = sub(velocity, cross(add(scale(lever_i, w_i), scale(lever_j, w_j)), n))
    moved, share_moved = ZERO, 1.0
    if REMEMBERS:
        rolled = cross(scale(lever, vector(scratch, TURNING, lane)), n)
        moved = scale(dt, sub(vector(scratch, DRIFT, lane), rolled))
        share_moved = share_since_touch(moved, n, overlap, held)
        moved = scale(share_moved, moved)
    turned = scale(dt, vector(scratch, TURNED, lane)) if TURNS else ZERO
    touch = Touch(overlap, n, velocity, w_i, w_j, r_i * r_j * share, r_i, r_j, per_mass, per_inertia, moved, turned)
    return touch, lever_i, lever_j, share_moved


@inlined
def read_drag(scratch: Floats, lane: int) -> Drag:
    """Return the drag of a lane's contact at the forces before."""
    return Drag(vector(scratch, DRAG, lane), vector(scratch, DRAG + 3, lane) if ROLLS else ZERO)


@inlined
def kept_drag(histories: Floats, k: int) -> Drag:
    """Return the drag that contact k had at the forces before."""
    return Drag(row(histories, k, 3 + HISTORY), row(histories, k, 6 + HISTORY) if ROLLS else ZERO)


@inlined
def contact_lane(scratch: Floats, lane: int, shared: Any, numbers: Numbers, dt: float) -> None:
    """Compute the contact of one lane: force on j, moments on both, new history."""
    touch, lever_i, lever_j, share_moved = read_touch(scratch, lane, numbers, dt)
    n = touch.normal
    constants = shared if ONE_MATERIAL else read_contact_constants(scratch, CONTACT_FREE, lane)
    history = read_history(scratch, HISTORY_BASE, lane)
    if HISTORY > 0:
        spin = 0.5 * (dot(touch.spin_i, n) + dot(touch.spin_j, n)) * dt
        history = carry_history(history, vector(scratch, NORMAL, lane), n, spin)
    load, kept = contact_load(touch, constants, history, abs(dt), CHOICES)  # some schemes step back
    put(scratch, CONTACT_F, lane, load.force)
    if SPIN:
        arm = cross(n, load.force)
        put(scratch, CONTACT_MI, lane, sub(load.torque_i, scale(lever_i, arm)))
        put(scratch, CONTACT_MJ, lane, sub(load.torque_j, scale(lever_j, arm)))
    if HISTORY > 0:
        put(scratch, NORMAL, lane, n)
        write_history(scratch, HISTORY_BASE, lane, kept)
    if CONTACT_LOSSES:
        lost = contact_losses(touch, constants, history, load, kept, dt, CHOICES, read_drag(scratch, lane))
        scratch[LOST * LANES + lane] = lost.viscous / share_moved  # drag acts all the way that the step is long
        scratch[(LOST + 1) * LANES + lane] = lost.sliding
        scratch[(LOST + 2) * LANES + lane] = lost.rolling
        scratch[(LOST + 3) * LANES + lane] = lost.stiffening
        if REACHES:
            jump = jump_at_touch(touch, constants, history, load.force, lost.drag, share_moved)
            scratch[(LOST + 3) * LANES + lane] = lost.stiffening + jump
        if YIELDS:
            scratch[(LOST + 4) * LANES + lane] = lost.plastic
        put(scratch, DRAG, lane, lost.drag.force)
        if ROLLS:
            put(scratch, DRAG + 3, lane, lost.drag.torque)


@inlined
def scatter(particles: Particles, pairs: Pairs, k: int, scratch: Floats, lane: int, book: Floats) -> None:
    """Add a lane's loads to those of its particles that belong to the chunk, keep its history, book its losses."""
    load, sides = particles.load, pairs.sides[k]
    i, j = pairs.first[k], pairs.second[k]
    force = vector(scratch, CONTACT_F, lane)
    own_i, own_j = own_ends(sides)
    take_from_row(load, i, F, force, own_i)
    add_to_row(load, j, F, force, own_j)
    if STRETCHES and sides & FIRST:
        book[BOX_POWER] -= dot(force, image_velocity(particles, i, j))
    if SPIN:
        add_to_row(load, i, M, vector(scratch, CONTACT_MI, lane), own_i)
        add_to_row(load, j, M, vector(scratch, CONTACT_MJ, lane), own_j)
    if HISTORY > 0:
        for c in range(3):
            pairs.history[k, c] = scratch[(NORMAL + c) * LANES + lane]
        for c in range(HISTORY):
            pairs.history[k, 3 + c] = scratch[(HISTORY_BASE + c) * LANES + lane]
    if CONTACT_LOSSES:
        for c in range(DRAG_NUMBERS):
            pairs.history[k, 3 + HISTORY + c] = scratch[(DRAG + c) * LANES + lane]
        if sides & FIRST:
            for term in range(4):
                book[term] += scratch[(LOST + term) * LANES + lane]
            if YIELDS:
                book[PLASTIC] += scratch[(LOST + 4) * LANES + lane]
    if REMEMBERS:
        pairs.touching[k] = 1
