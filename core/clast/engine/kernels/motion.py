"""Kicks and drifts of particles and walls around a force evaluation."""

from __future__ import annotations

from typing import Any

from clast.engine.compiler import inlined, routine
from clast.engine.state import Floats, Numbers, Particles
from clast.maths.rotation import turn
from clast.maths.vec3 import Vec, add, dot, scale
from clast.parts.integrator import Stage

from .images import box_of
from .lanes import put, row, vector
from .layout import (
    APPLIED_WORK,
    BODY_WORK,
    BRAKED,
    DRIVEN_WORK,
    INVERSE_INERTIA,
    INVERSE_MASS,
    LANES,
    MIDDLE,
    RADIUS,
    TURN_Q,
    TURN_W,
    WEIGHT,
    F,
    M,
    Q,
    V,
    W,
    X,
)
from .rows import set_first_half, set_half_row, set_row
from .slots import (
    APPLIED_LOADS,
    BODY_FORCES,
    BODY_LOADS,
    BRAKES,
    ORIENTATION,
    SPIN,
    STAGES,
    STEERS,
    STRETCHES,
    VELOCITY_FORCES,
    body_acceleration,
    body_load,
    braking,
)
from .stretching import shrunk, since_search

UNSTRETCHED = (1.0, 1.0, 1.0)


@inlined
def kick(particles: Particles, k: int, time: float) -> None:
    """Change the velocity and spin of particle k by its acceleration over some time."""
    if SPIN:
        set_row(particles.twist, k, particles.twist, time, particles.acceleration)
    else:
        set_first_half(particles.twist, k, particles.twist, time, particles.acceleration)


@inlined
def drift(particles: Particles, k: int, time: float) -> None:
    """Move particle k with its velocity over some time."""
    set_first_half(particles.pose, k, particles.pose, time, particles.twist)


@routine
def turn_all(particles: Particles, begin: int, end: int, scratch: Floats, time: float) -> None:
    """Turn particles with their spins over some time, in blocks of lanes."""
    pose, twist = particles.pose[begin:end], particles.twist[begin:end]
    for first in range(0, len(pose), LANES):
        count = min(LANES, len(pose) - first)
        for lane in range(count):
            for c in range(4):
                scratch[(TURN_Q + c) * LANES + lane] = pose[first + lane, Q + c]
                scratch[(TURN_W + c) * LANES + lane] = twist[first + lane, W + c]
        for lane in range(LANES):  # always all: a loop of fixed length vectorises
            turn_lane(scratch, lane, time)
        for lane in range(count):
            for c in range(4):
                pose[first + lane, Q + c] = scratch[(TURN_Q + c) * LANES + lane]


@inlined
def turn_lane(scratch: Floats, lane: int, time: float) -> None:
    """Turn the particle of one lane."""
    w, (x, y, z) = scratch[TURN_Q * LANES + lane], vector(scratch, TURN_Q + 1, lane)
    q = turn((w, x, y, z), vector(scratch, TURN_W, lane), time)
    scratch[TURN_Q * LANES + lane] = q[0]
    put(scratch, TURN_Q + 1, lane, (q[1], q[2], q[3]))


@inlined
def predict(particles: Particles, k: int, time: float) -> None:
    """Set the velocity and spin that the forces on particle k will see."""
    if SPIN:
        set_row(particles.seen, k, particles.twist, time, particles.acceleration)
    else:
        set_first_half(particles.seen, k, particles.twist, time, particles.acceleration)


@inlined
def begin_load(particles: Particles, k: int) -> None:
    """Forget the loads on particle k but those that act on it all the time."""
    for c in range(8):
        particles.load[k, c] = particles.applied[k, c] if APPLIED_LOADS else 0.0


@inlined
def strayed(particles: Particles, k: int, stretch: Vec) -> bool:
    """Tell whether particle k is too far from where neighbours were searched, or nowhere.

    ``stretch`` is what a box that is stretched has grown by since: places go with it, as long as nothing else moves.
    """
    pose, reference = particles.pose, particles.reference
    dx = pose[k, X] - reference[k, 0]
    dy = pose[k, X + 1] - reference[k, 1]
    dz = pose[k, X + 2] - reference[k, 2]
    if STRETCHES:
        dx -= (stretch[0] - 1.0) * (reference[k, 0] - box_of(particles)[MIDDLE, 0])
        dy -= (stretch[1] - 1.0) * (reference[k, 1] - box_of(particles)[MIDDLE, 1])
        dz -= (stretch[2] - 1.0) * (reference[k, 2] - box_of(particles)[MIDDLE, 2])
    return not dx * dx + dy * dy + dz * dz <= reference[k, 3]


@inlined
def move_before_forces(
    particles: Particles, begin: int, end: int, stage: Stage, numbers: Numbers, scratch: Floats, time: float
) -> bool:
    """Kick and drift to the force evaluation at a time, begin the loads; tell whether neighbour lists are stale."""
    dt = numbers.dt
    stale, stretch = False, UNSTRETCHED
    if STRETCHES:
        stretch = since_search(box_of(particles), time)
        stale = shrunk(stretch)
    for k in range(begin, end):
        if stage.kick_before != 0.0:
            kick(particles, k, stage.kick_before * dt)
        if stage.drift_before != 0.0:
            drift(particles, k, stage.drift_before * dt)
        if VELOCITY_FORCES:
            predict(particles, k, stage.predict * dt)
        begin_load(particles, k)
        if strayed(particles, k, stretch):
            stale = True
    if ORIENTATION and stage.drift_before != 0.0:
        turn_all(particles, begin, end, scratch, stage.drift_before * dt)
    return stale


@inlined
def half_kick(dt: float) -> float:
    """Return the time in s by which the mean velocities of two steps differ from that between them, 0 if several."""
    return 0.5 * dt if len(STAGES) == 1 else 0.0


@inlined
def body_force(particles: Particles, k: int, numbers: Numbers, time: float) -> Vec:
    """Return the acceleration of particle k by body forces."""
    acceleration: Vec = body_acceleration(numbers.body, row(particles.pose, k, X), row(particles.seen, k, V), time)
    return acceleration


@inlined
def load_by_body(particles: Particles, k: int, numbers: Numbers, time: float) -> tuple[Vec, Vec]:
    """Return the force and the torque of body forces on particle k."""
    x, v, w = row(particles.pose, k, X), row(particles.seen, k, V), row(particles.seen, k, W)
    found: tuple[Vec, Vec] = body_load(numbers.body, x, v, w, particles.pose[k, RADIUS], time)
    return found


@inlined
def book_outside_work(particles: Particles, k: int, numbers: Numbers, time: float, book: Floats, kicked: float) -> None:
    """Book the work on particle k of body forces, applied loads, and what drives it.

    Velocities are those at the force evaluation, half a step of acceleration after the kick before it, and ``kicked``
    is the time for which forces change velocities: with them the work of all forces together is the change of the
    kinetic energy, to the rounding, from the first step on. Schemes with several evaluations a step have no such
    velocity: theirs are those with which the way was made.
    """
    half = half_kick(numbers.dt)
    v = add(row(particles.twist, k, V), scale(half, row(particles.acceleration, k, F)))
    w = add(row(particles.twist, k, W), scale(half, row(particles.acceleration, k, M)))
    if APPLIED_LOADS:
        power = dot(row(particles.applied, k, F), v) + dot(row(particles.applied, k, M), w)
        book[APPLIED_WORK] += kicked * power
    if BODY_LOADS:
        force, torque = load_by_body(particles, k, numbers, time)
        book[BODY_WORK] += kicked * (dot(force, v) + dot(torque, w))
    per_mass = particles.body[k, INVERSE_MASS]
    if per_mass == 0.0:
        power = dot(row(particles.load, k, F), v) + dot(row(particles.load, k, M), w)
        book[DRIVEN_WORK] -= kicked * power
    elif BODY_FORCES:
        weight = particles.body[k, WEIGHT] / per_mass
        book[BODY_WORK] += kicked * weight * dot(body_force(particles, k, numbers, time), v)


@inlined
def accelerate(particles: Particles, k: int, numbers: Numbers, time: float) -> None:
    """Turn loads and body forces on particle k into accelerations."""
    load, acceleration = particles.load, particles.acceleration
    if BODY_LOADS:
        force, torque = load_by_body(particles, k, numbers, time)
        for c in range(3):
            load[k, F + c] += force[c]
            load[k, M + c] += torque[c]
    per_mass, per_inertia = particles.body[k, INVERSE_MASS], particles.body[k, INVERSE_INERTIA]
    set_half_row(acceleration, k, F, per_mass, load)
    if SPIN:
        set_half_row(acceleration, k, M, per_inertia, load)
    if BODY_FORCES and per_mass > 0.0:
        g = body_force(particles, k, numbers, time)
        for c in range(3):
            acceleration[k, F + c] += particles.body[k, WEIGHT] * g[c]


@inlined
def brake(particles: Particles, k: int, numbers: Numbers, how: Any, book: Floats, kicked: float) -> None:
    """Change the acceleration of particle k by the damping of motion; book its heat.

    The heat is at the same velocities as the work from outside: see ``book_outside_work``. ``how`` is what the damping
    is told: its numbers, or how it steers all particles.
    """
    acceleration, half = particles.acceleration, half_kick(numbers.dt)
    velocity = particles.twist if STEERS else particles.seen
    for inverse, first in ((INVERSE_MASS, F), (INVERSE_INERTIA, M)):
        if particles.body[k, inverse] > 0.0 and (first == F or SPIN):
            taken = braking(how, row(acceleration, k, first), row(velocity, k, first))
            for c in range(3):
                acceleration[k, first + c] += taken[c]
            v = add(row(particles.twist, k, first), scale(half, row(acceleration, k, first)))
            book[BRAKED] -= kicked / particles.body[k, inverse] * dot(taken, v)


@inlined
def move_after_forces(
    particles: Particles,
    begin: int,
    end: int,
    stage: Stage,
    numbers: Numbers,
    scratch: Floats,
    time: float,
    how: Any,
    book: Floats,
) -> None:
    """Compute accelerations, kick, and drift to the end of the stage; book the work of what acts from outside.

    Where a damping steers all particles, accelerations are there already: it had to ask for them.
    """
    dt = numbers.dt
    kicked = (stage.kick_before + stage.kick_after) * dt
    for k in range(begin, end):
        if not STEERS:
            accelerate(particles, k, numbers, time)
        if BRAKES:
            brake(particles, k, numbers, how, book, kicked)
        book_outside_work(particles, k, numbers, time, book, kicked)
        if stage.kick_after != 0.0:
            kick(particles, k, stage.kick_after * dt)
        if stage.drift_after != 0.0:
            drift(particles, k, stage.drift_after * dt)
    if ORIENTATION and stage.drift_after != 0.0:
        turn_all(particles, begin, end, scratch, stage.drift_after * dt)
