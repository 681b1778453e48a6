"""Contacts between particles and walls, one by one: they are few."""

from __future__ import annotations

from typing import Any

from clast.engine.compiler import inlined, routine
from clast.engine.state import Floats, Numbers, Particles, WallPairs, Walls
from clast.maths.rotation import IDENTITY
from clast.maths.vec3 import ZERO, Vec, add, cross, dot, scale, sub
from clast.parts.contact_law import NO_DRAG, ContactLoad, Touch
from clast.parts.motion import Pushed
from clast.parts.wall import Nearest

from .contact_lane import kept_drag
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
from .parting import energy_left, energy_let_go, jump_at_touch, reach_of, still
from .slots import (
    ANSWERING,
    CHOICES,
    CONTACT_LOSSES,
    CURVED_WALLS,
    HISTORY,
    MANIFOLDS,
    REACHES,
    REMEMBERS,
    ROLLS,
    SPIN,
    TURNS,
    VELOCITY_FORCES,
    WALLS_TURN,
    YIELDS,
    carry_history,
    contact_load,
    contact_losses,
    fresh_history,
    load_history,
    row_constants,
    store_history,
    wall_inverse_mass,
)
from .touching import share_since_touch
from .wall_frames import from_centre, orientation, spin_of_wall, velocity_of_wall
from .wall_motion import book_wall_work
from .wall_places import place_on_wall


@inlined
def wall_reach(particles: Particles, walls: Walls, pairs: WallPairs, numbers: Numbers, p: int) -> float:
    """Return the distance in m from which on wall pair p does not touch: beyond the radius where a contact holds on."""
    w, k = pairs.wall[p], pairs.particle[p]
    radius: float = particles.pose[k, RADIUS]
    if REACHES and pairs.touching[p] != 0:
        radius += reach_of(radius, 0.0, wall_constants(particles, walls, numbers, k, w))
    return radius


@inlined
def farthest(particles: Particles, walls: Walls, numbers: Numbers, k: int, w: int) -> float:
    """Return how far beyond touch contacts of particle k and wall w are looked for, in m: twice as far as they hold."""
    if MANIFOLDS and REACHES:
        return 2.0 * reach_of(particles.pose[k, RADIUS], 0.0, wall_constants(particles, walls, numbers, k, w))
    return 0.0


@inlined
def wall_constants(particles: Particles, walls: Walls, numbers: Numbers, k: int, w: int) -> Any:
    """Return the constants of particle k and wall w."""
    return row_constants(numbers.contact_table[int(particles.body[k, MATERIAL]), walls.material[w]])


@inlined
def inverse_mass(particles: Particles, walls: Walls, numbers: Numbers, k: int, w: int, n: Vec, lever: float) -> float:
    """Return 1/m* of particle k and wall w in 1/kg, which touch along n at a lever from the particle's centre.

    All contacts of a wall that gives way push it together: each has its share of the mass to itself.
    """
    own: float = particles.body[k, INVERSE_MASS]
    if ANSWERING:
        arm = from_centre(walls, w, add(row(particles.pose, k, X), scale(lever, n)))
        turned = orientation(walls, w) if WALLS_TURN else IDENTITY
        own += max(walls.pushes[w], 1) * wall_inverse_mass(walls, w, Pushed(n, arm, turned, numbers.mass))
    return own


@inlined
def apart(particles: Particles, walls: Walls, pairs: WallPairs, numbers: Numbers, p: int, near: Nearest) -> bool:
    """Tell whether wall pair p does not touch, or neither of the two gives way, so that nothing comes of it."""
    w, k, lever = pairs.wall[p], pairs.particle[p], particles.pose[pairs.particle[p], RADIUS]
    if near.distance >= wall_reach(particles, walls, pairs, numbers, p):
        return True
    return ANSWERING and inverse_mass(particles, walls, numbers, k, w, near.normal, lever) == 0.0


@inlined
def wall_touch(
    particles: Particles,
    walls: Walls,
    numbers: Numbers,
    k: int,
    w: int,
    near: Nearest,
    lever: float,
    held: bool,
    dt: float,
) -> tuple[Touch, float]:
    """Return the contact of particle k (i) with wall w (j), and the share of the way since touch.

    ``held`` tells whether the contact was there at the forces before; it counts where contacts hold beyond touch.
    """
    seen, body = particles.seen, particles.body
    radius, distance, n = particles.pose[k, RADIUS], near.distance, near.normal
    wall_velocity = velocity_of_wall(walls, w, add(row(particles.pose, k, X), scale(lever, n)))
    velocity, spin, moved, share_moved = ZERO, ZERO, ZERO, 1.0
    if REMEMBERS:
        drift = sub(wall_velocity, row(particles.twist, k, V))
        slip = sub(drift, cross(scale(lever, row(particles.twist, k, W)), n))
        share_moved = share_since_touch(scale(dt, slip), n, radius - distance, REACHES and held)
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
        spin_j=spin_of_wall(walls, w),
        radius=radius,
        radius_i=radius,
        radius_j=0.0,
        inverse_mass=inverse_mass(particles, walls, numbers, k, w, n, lever),
        inverse_inertia=body[k, INVERSE_INERTIA],
        moved=moved,
        turned=scale(dt, sub(spin_of_wall(walls, w), row(particles.twist, k, W))) if TURNS else ZERO,
    )
    return touch, share_moved


@inlined
def push(particles: Particles, walls: Walls, k: int, w: int, told: ContactLoad, lever: float, n: Vec) -> None:
    """Add a wall contact's loads to particle k and to wall w."""
    load, force = particles.load, told.force
    arm = cross(n, force)
    place = from_centre(walls, w, row(particles.pose, k, X))
    about = cross((place[0] + lever * n[0], place[1] + lever * n[1], place[2] + lever * n[2]), force)
    for c in range(3):
        load[k, F + c] -= force[c]
        walls.force[w, c] += force[c]
        walls.moment[w, c] += about[c] + told.torque_j[c] if ROLLS else about[c]
        if SPIN:
            load[k, M + c] += told.torque_i[c] - lever * arm[c]


@inlined
def book_parting(
    walls: Walls,
    pairs: WallPairs,
    particles: Particles,
    numbers: Numbers,
    p: int,
    near: Nearest,
    book: Floats,
    dt: float,
) -> None:
    """Book what the drag of the last evaluation still takes up while wall pair p parts, and what its springs held."""
    w, k = pairs.wall[p], pairs.particle[p]
    last, apart = kept_drag(pairs.history, p), parting_velocity(particles, walls, k, w, row(pairs.history, p, 0))
    book[VISCOUS] += 0.5 * dt * dot(last.force, apart)
    book[ROLLING] -= 0.5 * dt * dot(last.torque, sub(row(particles.twist, k, W), spin_of_wall(walls, w)))
    if REACHES:
        book[STIFFENING] += pull_off_loss(walls, pairs, particles, numbers, p, near, dt)
    elif HISTORY > 0:
        constants = wall_constants(particles, walls, numbers, k, w)
        book[STIFFENING] += energy_left(particles.pose[k, RADIUS], 0.0, constants, pairs.history, p)


@inlined
def parting_velocity(particles: Particles, walls: Walls, k: int, w: int, n: Vec) -> Vec:
    """Return the velocity of wall w, where particle k touched it with the normal n, against the particle."""
    place = add(row(particles.pose, k, X), scale(particles.pose[k, RADIUS], n))
    return sub(velocity_of_wall(walls, w, place), row(particles.twist, k, V))


@inlined
def pull_off_loss(
    walls: Walls, pairs: WallPairs, particles: Particles, numbers: Numbers, p: int, near: Nearest, dt: float
) -> float:
    """Return the energy in J that wall pair p loses as it ends beyond touch."""
    w, k = pairs.wall[p], pairs.particle[p]
    radius = particles.pose[k, RADIUS]
    opened = dt * dot(parting_velocity(particles, walls, k, w, near.normal), near.normal)
    then = still(radius, 0.0, radius - near.distance + opened, near.normal)
    return energy_let_go(then, opened, wall_constants(particles, walls, numbers, k, w), pairs.history, p, dt)


@routine
def count_contacts(walls: Walls, pairs: WallPairs, particles: Particles, numbers: Numbers) -> None:
    """Count the contacts of each wall."""
    for w in range(len(walls.pushes)):
        walls.pushes[w] = 0
    for p in range(len(pairs.wall)):
        w = pairs.wall[p]
        near = place_on_wall(particles, walls, pairs, p, farthest(particles, walls, numbers, pairs.particle[p], w))
        if near.distance < wall_reach(particles, walls, pairs, numbers, p):
            walls.pushes[w] += 1


@routine
def sweep_walls(
    walls: Walls, pairs: WallPairs, particles: Particles, numbers: Numbers, book: Floats, dt: float
) -> None:
    """Add the loads of all wall contacts to particles and walls, in the order of the pairs; book losses and work."""
    if ANSWERING:
        count_contacts(walls, pairs, particles, numbers)
    for p in range(len(pairs.wall)):
        w, k = pairs.wall[p], pairs.particle[p]
        near = place_on_wall(particles, walls, pairs, p, farthest(particles, walls, numbers, k, w))
        radius = particles.pose[k, RADIUS]
        if apart(particles, walls, pairs, numbers, p, near):
            if CONTACT_LOSSES and pairs.touching[p] != 0:
                book_parting(walls, pairs, particles, numbers, p, near, book, dt)
            pairs.touching[p] = 0
            continue
        n = near.normal
        lever = radius - numbers.lever * (radius - near.distance)
        held = pairs.touching[p] != 0
        touch, share_moved = wall_touch(particles, walls, numbers, k, w, near, lever, held, dt)
        history = fresh_history()
        if HISTORY > 0 and held:
            spin = 0.5 * dot(add(touch.spin_i, touch.spin_j), n) * dt
            history = carry_history(load_history(pairs.history[p]), row(pairs.history, p, 0), n, spin)
        constants = wall_constants(particles, walls, numbers, k, w)
        load, kept = contact_load(touch, constants, history, abs(dt), CHOICES)  # some schemes step back
        push(particles, walls, k, w, load, lever, n)
        if CURVED_WALLS:
            walls.pressing[w] += dot(load.force, n)
        if HISTORY > 0 or (MANIFOLDS and REMEMBERS):
            for c in range(3):
                pairs.history[p, c] = n[c]
        if HISTORY > 0:
            store_history(pairs.history[p], kept)
        if CONTACT_LOSSES:
            drag = kept_drag(pairs.history, p) if held else NO_DRAG
            lost = contact_losses(touch, constants, history, load, kept, dt, CHOICES, drag)
            book[VISCOUS] += lost.viscous / share_moved  # drag acts all the way that the step is long
            book[SLIDING] += lost.sliding
            book[ROLLING] += lost.rolling
            book[STIFFENING] += lost.stiffening
            if REACHES:
                book[STIFFENING] += jump_at_touch(touch, constants, history, load.force, lost.drag, share_moved)
            if YIELDS:
                book[PLASTIC] += lost.plastic
            for c in range(3):
                pairs.history[p, 3 + HISTORY + c] = lost.drag.force[c]
                if ROLLS:
                    pairs.history[p, 6 + HISTORY + c] = lost.drag.torque[c]
        pairs.touching[p] = 1
    book_wall_work(walls, dt, book)
