"""Contacts between particles and walls, one by one: they are few."""

from __future__ import annotations

from clast.engine.compiler import inlined, routine
from clast.engine.state import Floats, Numbers, Particles, WallPairs, Walls
from clast.maths.vec3 import ZERO, Vec, cross, dot, scale, sub
from clast.parts.contact_law import NO_DRAG, Touch

from .contact_lane import energy_left, kept_drag
from .lanes import row
from .layout import (
    INVERSE_INERTIA,
    INVERSE_MASS,
    MATERIAL,
    PLASTIC,
    RADIUS,
    ROLLING,
    SLIDING,
    STIFFENING,
    VISCOUS,
    F,
    M,
    V,
    W,
    X,
)
from .motion import book_wall_work
from .slots import (
    CHOICES,
    CONTACT_LOSSES,
    CURVED_WALLS,
    HISTORY,
    REMEMBERS,
    ROLLS,
    SPIN,
    TURNS,
    VELOCITY_FORCES,
    YIELDS,
    carry_history,
    contact_load,
    contact_losses,
    fresh_history,
    load_history,
    row_constants,
    store_history,
    wall_nearest,
)
from .touching import share_since_touch


@inlined
def wall_touch(
    particles: Particles, k: int, distance: float, n: Vec, lever: float, wall_velocity: Vec, dt: float
) -> tuple[Touch, float]:
    """Return the contact of particle k (i) with a wall (j), and the share of the way since touch."""
    seen, body = particles.seen, particles.body
    radius = particles.pose[k, RADIUS]
    velocity, spin, moved, share_moved = ZERO, ZERO, ZERO, 1.0
    if REMEMBERS:
        drift = sub(wall_velocity, row(particles.twist, k, V))
        slip = sub(drift, cross(scale(lever, row(particles.twist, k, W)), n))
        share_moved = share_since_touch(scale(dt, slip), n, radius - distance)
        moved = scale(share_moved * dt, slip)
    if VELOCITY_FORCES:
        velocity = sub(wall_velocity, row(seen, k, V))
    if SPIN:
        spin = row(seen, k, W)
        velocity = sub(velocity, cross(scale(lever, spin), n))
    touch = Touch(
        overlap=radius - distance,
        normal=n,
        velocity=velocity,
        spin_i=spin,
        spin_j=ZERO,
        radius=radius,
        radius_i=radius,
        radius_j=0.0,
        inverse_mass=body[k, INVERSE_MASS],
        inverse_inertia=body[k, INVERSE_INERTIA],
        moved=moved,
        turned=scale(-dt, row(particles.twist, k, W)) if TURNS else ZERO,
    )
    return touch, share_moved


@inlined
def push(particles: Particles, walls: Walls, k: int, w: int, force: Vec, torque: Vec, lever: float, n: Vec) -> None:
    """Add a wall contact's loads to particle k and to wall w."""
    load = particles.load
    arm = cross(n, force)
    place = sub(sub(row(particles.pose, k, X), row(walls.displacement, w, 0)), row(walls.centre, w, 0))
    about = cross((place[0] + lever * n[0], place[1] + lever * n[1], place[2] + lever * n[2]), force)
    for c in range(3):
        load[k, F + c] -= force[c]
        walls.force[w, c] += force[c]
        walls.moment[w, c] += about[c]
        if SPIN:
            load[k, M + c] += torque[c] - lever * arm[c]


@inlined
def book_parting(
    walls: Walls, pairs: WallPairs, particles: Particles, numbers: Numbers, p: int, book: Floats, dt: float
) -> None:
    """Book what the drag of the last evaluation still takes up while wall pair p parts, and what its springs held."""
    w, k = pairs.wall[p], pairs.particle[p]
    last, apart = kept_drag(pairs.history, p), sub(row(walls.velocity, w, 0), row(particles.twist, k, V))
    book[VISCOUS] += 0.5 * dt * dot(last.force, apart)
    book[ROLLING] -= 0.5 * dt * dot(last.torque, row(particles.twist, k, W))
    if HISTORY > 0:
        constants = row_constants(numbers.contact_table[int(particles.body[k, MATERIAL]), walls.material[w]])
        book[STIFFENING] += energy_left(particles.pose[k, RADIUS], 0.0, constants, pairs.history, p)


@routine
def sweep_walls(
    walls: Walls, pairs: WallPairs, particles: Particles, numbers: Numbers, book: Floats, dt: float
) -> None:
    """Add the loads of all wall contacts to particles and walls, in the order of the pairs; book losses and work."""
    for p in range(len(pairs.wall)):
        w, k = pairs.wall[p], pairs.particle[p]
        x = sub(row(particles.pose, k, X), row(walls.displacement, w, 0))
        near = wall_nearest(walls.shape_kind[w], walls.shape[w], x)
        radius = particles.pose[k, RADIUS]
        if near.distance >= radius:
            if CONTACT_LOSSES and pairs.touching[p] != 0:
                book_parting(walls, pairs, particles, numbers, p, book, dt)
            pairs.touching[p] = 0
            continue
        n = near.normal
        lever = radius - numbers.lever * (radius - near.distance)
        touch, share_moved = wall_touch(particles, k, near.distance, n, lever, row(walls.velocity, w, 0), dt)
        history = fresh_history()
        if HISTORY > 0 and pairs.touching[p] != 0:
            spin = 0.5 * dot(touch.spin_i, n) * dt
            history = carry_history(load_history(pairs.history[p]), row(pairs.history, p, 0), n, spin)
        constants = row_constants(numbers.contact_table[int(particles.body[k, MATERIAL]), walls.material[w]])
        load, kept = contact_load(touch, constants, history, abs(dt), CHOICES)  # some schemes step back
        push(particles, walls, k, w, load.force, load.torque_i, lever, n)
        if CURVED_WALLS:
            walls.pressing[w] += dot(load.force, n)
        if HISTORY > 0:
            for c in range(3):
                pairs.history[p, c] = n[c]
            store_history(pairs.history[p], kept)
        if CONTACT_LOSSES:
            drag = kept_drag(pairs.history, p) if pairs.touching[p] != 0 else NO_DRAG
            lost = contact_losses(touch, constants, history, load, kept, dt, CHOICES, drag)
            book[VISCOUS] += lost.viscous / share_moved  # drag acts all the way that the step is long
            book[SLIDING] += lost.sliding
            book[ROLLING] += lost.rolling
            book[STIFFENING] += lost.stiffening
            if YIELDS:
                book[PLASTIC] += lost.plastic
            for c in range(3):
                pairs.history[p, 3 + HISTORY + c] = lost.drag.force[c]
                if ROLLS:
                    pairs.history[p, 6 + HISTORY + c] = lost.drag.torque[c]
        pairs.touching[p] = 1
    book_wall_work(walls, dt, book)
