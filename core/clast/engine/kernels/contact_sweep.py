"""Contacts between particles: find the touching pairs, and compute them in blocks of lanes."""

from __future__ import annotations

from math import sqrt
from typing import Any

from clast.engine.compiler import inlined, routine
from clast.engine.state import Bonds, Floats, Indices, Numbers, Pairs, Particles
from clast.maths.vec3 import Vec, dot, scale, sub

from .ahead import LINE, ask_for
from .contact_lane import DRAG_NUMBERS, contact_lane, gather, kept_drag, radii, read_touch, scatter
from .images import box_of, nearest, velocity_between, way_between
from .lanes import put, row, vector
from .layout import (
    FIRST,
    INTACT,
    LANES,
    MATERIAL,
    REST,
    RI,
    RJ,
    ROLLING,
    STIFFENING,
    VISCOUS,
    WOKEN,
    D,
    W,
    X,
)
from .parting import energy_left, energy_let_go, reach_of, still
from .slots import (
    BONDED_PAIRS_TOUCH,
    CHOICES,
    CHUNKED,
    CONTACT_LOSSES,
    HISTORY,
    ONE_SIZE,
    PERIODIC,
    REACHES,
    REMEMBERS,
    RESTS,
    ROLLS,
    VELOCITY_FORCES,
    contact_energy,
    fresh_history,
    row_constants,
)

AHEAD = 32
"""Pairs between asking for numbers and needing them: long enough to come, short enough to stay."""


@inlined
def meet(particles: Particles, pairs: Pairs, k: int, numbers: Numbers, scratch: Floats, lane: int) -> bool:
    """Copy the distance and the radii of pair k into a lane; tell whether the particles touch, or hold beyond touch."""
    pose = particles.pose
    i, j = pairs.first[k], pairs.second[k]
    d = (pose[j, X] - pose[i, X], pose[j, X + 1] - pose[i, X + 1], pose[j, X + 2] - pose[i, X + 2])
    if PERIODIC:
        d = nearest(box_of(particles), d)
    r_i, r_j = radii(particles, i, j, numbers)
    put(scratch, D, lane, d)
    if not ONE_SIZE:
        scratch[RI * LANES + lane] = r_i
        scratch[RJ * LANES + lane] = r_j
    reach = r_i + r_j
    if RESTS:
        scratch[REST * LANES + lane] = pairs.rest[k]
        reach -= pairs.rest[k]
    if REACHES and pairs.touching[k] != 0 and dot(d, d) >= reach * reach:
        reach += reach_of(r_i, r_j, pair_constants(particles, pairs, k, numbers))
    return not dot(d, d) >= reach * reach


@inlined
def pair_constants(particles: Particles, pairs: Pairs, k: int, numbers: Numbers) -> Any:
    """Return the constants of pair k."""
    i, j = int(particles.body[pairs.first[k], MATERIAL]), int(particles.body[pairs.second[k], MATERIAL])
    return row_constants(numbers.contact_table[i, j])


@inlined
def book_parting(particles: Particles, pairs: Pairs, k: int, numbers: Numbers, dt: float, book: Floats) -> None:
    """Book what the drag of the last evaluation still takes up while pair k comes apart, and what its springs held."""
    twist, i, j = particles.twist, pairs.first[k], pairs.second[k]
    last = kept_drag(pairs.history, k)
    book[VISCOUS] += 0.5 * dt * dot(last.force, velocity_between(particles, twist, i, j))
    if ROLLS:
        book[ROLLING] += 0.5 * dt * dot(last.torque, sub(row(twist, j, W), row(twist, i, W)))
    if REACHES:
        book[STIFFENING] += pull_off_loss(particles, pairs, k, numbers, dt)
    elif HISTORY > 0:
        r_i, r_j = radii(particles, i, j, numbers)
        constants = pair_constants(particles, pairs, k, numbers)
        book[STIFFENING] += energy_left(r_i, r_j, constants, pairs.history, k)


@inlined
def pull_off_loss(particles: Particles, pairs: Pairs, k: int, numbers: Numbers, dt: float) -> float:
    """Return the energy in J that pair k loses as it ends beyond touch."""
    i, j = pairs.first[k], pairs.second[k]
    r_i, r_j = radii(particles, i, j, numbers)
    d = way_between(particles, i, j)
    distance = sqrt(dot(d, d))
    n = scale(1.0 / distance, d)
    opened = dt * dot(velocity_between(particles, particles.twist, i, j), n)
    then = still(r_i, r_j, r_i + r_j - distance - pairs.rest[k] + opened, n)
    return energy_let_go(then, opened, pair_constants(particles, pairs, k, numbers), pairs.history, k, dt)


@inlined
def forget(pairs: Pairs, k: int) -> None:
    """Note that pair k has come apart: when it meets again it begins anew."""
    pairs.touching[k] = 0
    for c in range(3 + HISTORY + DRAG_NUMBERS):
        pairs.history[k, c] = 0.0


@inlined
def forget_rest(particles: Particles, pairs: Pairs, k: int, numbers: Numbers, d: Vec) -> None:
    """Let pair k, d from each other, push from touch on once its particles have been wholly apart.

    What they overlapped at the start without pushing was their shape where they had grown together.
    """
    r_i, r_j = radii(particles, pairs.first[k], pairs.second[k], numbers)
    if dot(d, d) >= (r_i + r_j) * (r_i + r_j):
        pairs.rest[k] = 0.0


@inlined
def joined(pairs: Pairs, bonds: Bonds, k: int) -> bool:
    """Tell whether an intact bond stands in for the contact of pair k."""
    place = pairs.bond[k]
    return place >= 0 and bool(bonds.data[place // LANES, INTACT * LANES + place % LANES] == 1.0)


@routine
def waking_energy(
    particles: Particles, pairs: Pairs, k: int, numbers: Numbers, scratch: Floats, lane: int, dt: float
) -> float:
    """Return the elastic energy that the contact of pair k begins with, because its bond has just broken, in J.

    The bond broke, on average, half-way between the last two force evaluations: what counts is the overlap there.
    """
    now = vector(scratch, D, lane)
    back = scale(0.5 * dt, velocity_between(particles, particles.twist, pairs.first[k], pairs.second[k]))
    gather(particles, pairs, k, numbers, scratch, lane)
    put(scratch, D, lane, sub(now, back))
    touch, _, _, _ = read_touch(scratch, lane, numbers, 0.0)
    put(scratch, D, lane, now)
    constants = pair_constants(particles, pairs, k, numbers)
    energy: float = contact_energy(touch, constants, fresh_history(), CHOICES)
    return energy


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
        contact_lane(scratch, lane, shared, numbers, dt)
    for lane in range(count):
        scatter(particles, pairs, active[lane], scratch, lane, book)


@inlined
def ask_for_pair(pairs: Pairs, k: int, particles: Particles) -> None:
    """Ask for what pair k needs, but for its first particle: that comes in order."""
    j = int(pairs.second[k])
    ask_for(particles.pose, LINE * j)
    ask_for(particles.load, LINE * j)
    if VELOCITY_FORCES:
        ask_for(particles.seen, LINE * j)
    if REMEMBERS:
        ask_for(particles.twist, LINE * j)
        ask_for(pairs.history, k * pairs.history.shape[1])


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
    """Add the loads of a chunk's touching pairs to its particles, in the order of the pairs; book their losses.

    Whether a pair touches is not to be guessed, so it is counted, not branched on.
    """
    count = 0
    for k in range(pairs.begin[chunk], pairs.end[chunk]):
        if CHUNKED:
            ask_for_pair(pairs, min(k + AHEAD, len(pairs.first) - 1), particles)
        touches = 1 if meet(particles, pairs, k, numbers, scratch, count) else 0
        if not BONDED_PAIRS_TOUCH and pairs.bond[k] >= 0:
            if joined(pairs, bonds, k):
                touches = 0
            else:
                pairs.bond[k] = -1
                if touches and pairs.sides[k] & FIRST:
                    book[WOKEN] += waking_energy(particles, pairs, k, numbers, scratch, count, dt)
        if RESTS and touches == 0:
            forget_rest(particles, pairs, k, numbers, vector(scratch, D, count))
        if REMEMBERS and pairs.touching[k] > touches:
            if CONTACT_LOSSES and pairs.sides[k] & FIRST:
                book_parting(particles, pairs, k, numbers, dt, book)
            forget(pairs, k)
        active[count] = k
        count += touches
        if count == LANES:
            apply(particles, pairs, active, count, numbers, scratch, book, dt)
            count = 0
    if count > 0:
        apply(particles, pairs, active, count, numbers, scratch, book, dt)
