"""The contact network: what touches where, and with what force; computed when asked, changing nothing."""

from __future__ import annotations

from math import sqrt

import numpy as np

from clast.engine.compiler import compiled, inlined, routine
from clast.engine.state import Bonds, Floats, Integers, Numbers, Pairs, Particles, World
from clast.maths.vec3 import Vec, add, dot, scale, sub
from clast.parts.contact_law import ContactLoad, Touch

from .contact_lane import HISTORY_BASE, gather, read_touch
from .contact_sweep import joined, meet
from .energies import SINCE_FORCES
from .lanes import row, vector
from .layout import CONTACT_FREE, FIRST, LANES, MATERIAL, NORMAL, RADIUS, D, X
from .slots import (
    BONDED_PAIRS_TOUCH,
    CHOICES,
    CONTACTS,
    HISTORY,
    ONE_MATERIAL,
    WALLS,
    carry_history,
    contact_load,
    fresh_history,
    load_history,
    read_contact_constants,
    read_history,
    row_constants,
)
from .wall_places import place_on_wall
from .wall_sweep import apart, farthest, wall_constants, wall_touch

FREE_LANES = max(HISTORY_BASE + HISTORY + 1, CONTACT_FREE + 1) * LANES


@compiled
def network(world: World, moving: bool, grain: Integers, inside: bool, output: Floats) -> int:
    """Return how many contacts there are, and write as many of them as ``output`` has rows.

    Forces are those at the present positions: tangential springs are brought there from the last force evaluation,
    dashpots see the velocities that forces saw last.

    Parameters
    ----------
    world : World
    moving : bool
        Whether a step was taken; else nothing has moved since the forces.
    grain : (n,) int64
        Number of each particle's grain, below 0 for none.
    inside : bool
        Whether contacts between particles of one grain count too.
    output : (k, 10) float64
        Contacts of particles in the order of their list, then those of walls: i; j, or −1 − w for wall w; contact
        point in m; force on j in N; its part along the normal, pressure positive; the size of its part across.
    """
    time = SINCE_FORCES * world.numbers.dt if moving else 0.0
    found = 0
    if CONTACTS:
        scratch = np.empty(FREE_LANES)
        particles, pairs, bonds, numbers = world.particles, world.pairs, world.bonds, world.numbers
        for k in range(len(pairs.first)):
            if counts(particles, pairs, bonds, numbers, k, grain, inside, scratch):
                if found < len(output):
                    write_pair(world, k, scratch, time, output[found])
                found += 1
    if WALLS:
        for p in range(len(world.wall_pairs.wall)):
            if write_wall_contact(world, p, time, found, output):
                found += 1
    return found


@inlined
def counts(
    particles: Particles,
    pairs: Pairs,
    bonds: Bonds,
    numbers: Numbers,
    k: int,
    grain: Integers,
    inside: bool,
    scratch: Floats,
) -> bool:
    """Tell whether pair k touches and is asked for; copy its distance and radii into the first lane."""
    i, j = pairs.first[k], pairs.second[k]
    if pairs.sides[k] & FIRST == 0 or not (inside or grain[i] < 0 or grain[i] != grain[j]):
        return False
    if not BONDED_PAIRS_TOUCH and joined(pairs, bonds, k):
        return False
    return bool(meet(particles, pairs, k, numbers, scratch, 0))


@inlined
def touch_of_pair(world: World, k: int, scratch: Floats, time: float) -> tuple[Touch, ContactLoad]:
    """Return the contact of pair k, which touches and lies in the first lane, and its load a time after the forces."""
    particles, pairs, numbers = world.particles, world.pairs, world.numbers
    i, j = pairs.first[k], pairs.second[k]
    gather(particles, pairs, k, numbers, scratch, 0)
    touch, _, _, _ = read_touch(scratch, 0, numbers, time)
    materials = int(particles.body[i, MATERIAL]), int(particles.body[j, MATERIAL])
    constants = row_constants(numbers.contact_table[materials])
    if not ONE_MATERIAL:
        constants = read_contact_constants(scratch, CONTACT_FREE, 0)
    history = read_history(scratch, HISTORY_BASE, 0)
    if HISTORY > 0:
        spin = 0.5 * (dot(touch.spin_i, touch.normal) + dot(touch.spin_j, touch.normal)) * time
        history = carry_history(history, vector(scratch, NORMAL, 0), touch.normal, spin)
    load, _ = contact_load(touch, constants, history, law_time(time, numbers.dt), CHOICES)
    return touch, load


@routine
def write_pair(world: World, k: int, scratch: Floats, time: float, found: Floats) -> None:
    """Write the contact of pair k, which touches and lies in the first lane."""
    touch, load = touch_of_pair(world, k, scratch, time)
    pose, i, j = world.particles.pose, world.pairs.first[k], world.pairs.second[k]
    share = pose[i, RADIUS] / (pose[i, RADIUS] + pose[j, RADIUS])
    point = add(row(pose, i, X), scale(share, vector(scratch, D, 0)))
    write(found, float(i), float(j), point, load.force, touch.normal)


@routine
def write_wall_contact(world: World, p: int, time: float, place: int, output: Floats) -> bool:
    """Tell whether wall pair p touches, and write its contact where there is room."""
    particles, walls, pairs, numbers = world.particles, world.walls, world.wall_pairs, world.numbers
    w, k = pairs.wall[p], pairs.particle[p]
    centre, radius = row(particles.pose, k, X), particles.pose[k, RADIUS]
    near = place_on_wall(particles, walls, pairs, p, farthest(particles, walls, numbers, k, w))
    if apart(particles, walls, pairs, numbers, p, near):
        return False
    if place < len(output):
        n, lever = near.normal, radius - numbers.lever * (radius - near.distance)
        held = pairs.touching[p] != 0
        touch, _ = wall_touch(particles, walls, numbers, k, w, near, lever, held, time)
        history = fresh_history()
        if HISTORY > 0 and held:
            spin = 0.5 * dot(touch.spin_i, n) * time
            history = carry_history(load_history(pairs.history[p]), row(pairs.history, p, 0), n, spin)
        constants = wall_constants(particles, walls, numbers, k, w)
        load, _ = contact_load(touch, constants, history, law_time(time, numbers.dt), CHOICES)
        write(output[place], float(k), -1.0 - w, add(centre, scale(near.distance, n)), load.force, n)
    return True


@inlined
def law_time(time: float, dt: float) -> float:
    """Return a time since the last forces that a law can divide by, although nothing may have moved since."""
    return time if time > 0.0 else dt


@inlined
def write(found: Floats, i: float, j: float, point: Vec, force: Vec, n: Vec) -> None:
    """Write one row."""
    along = dot(force, n)
    across = sub(force, scale(along, n))
    found[0], found[1] = i, j
    for c in range(3):
        found[2 + c] = point[c]
        found[5 + c] = force[c]
    found[8], found[9] = along, sqrt(dot(across, across))
