"""Energies that a scene holds, at one time: state functions of the laws, computed when asked."""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.engine.compiler import compiled, inlined, routine
from clast.engine.state import Bonds, Floats, Indices, Numbers, Pairs, Particles, WallPairs, Walls, World
from clast.maths.vec3 import dot, scale
from clast.parts.contact_law import NO_DRAG, Drag, Touch

from .bond_lane import gather as gather_ends
from .bond_lane import read_motion
from .contact_lane import HISTORY_BASE, gather, kept_drag, read_drag, read_touch
from .contact_sweep import joined, meet
from .going_back import go_back, time_now
from .images import box_of
from .lanes import row, vector
from .layout import (
    BOND_SCRATCH,
    BOX_POWER,
    CONTACT_F,
    CONTACT_FREE,
    ENERGY,
    FIRST,
    INTACT,
    INVERSE_INERTIA,
    INVERSE_MASS,
    LANES,
    LOST,
    MATERIAL,
    NORMAL,
    RADIUS,
    ROLLING,
    SLIDING,
    STIFFENING,
    VISCOUS,
    V,
    W,
)
from .motion import half_kick
from .slots import (
    BONDED_PAIRS_TOUCH,
    BONDS,
    CHOICES,
    CONTACT_LOSSES,
    CONTACTS,
    HISTORY,
    LAG,
    ONE_MATERIAL,
    STAGES,
    STRETCHES,
    WALLS,
    YIELDS,
    bond_energy,
    bond_flow,
    bond_measure,
    carry_history,
    contact_energy,
    contact_load,
    contact_losses,
    fresh_history,
    load_history,
    no_losses,
    read_bond_state,
    read_constants,
    read_contact_constants,
    read_history,
    read_kinematic_state,
    read_reference,
    read_uniforms,
    row_constants,
)
from .stretching import stretch_box
from .wall_frames import power_on_wall
from .wall_places import place_on_wall
from .wall_sweep import apart, farthest, wall_constants, wall_touch

SINCE_FORCES = STAGES[len(STAGES) - 1].drift_after
"""Time since the last force evaluation when a step is over, as a fraction of the step."""

CONTACT_ENERGY = CONTACT_F
"""Slot of the energy of a lane's contact, where its force is not computed."""

LATEST, YIELDED, WALLS_DID, BOX_DID = 3, 4, 5, 6
"""Where losses since the last force evaluation begin among the energies; there, the places of yielding, of walls and of
a box that is stretched."""


@compiled
def energies(world: World, moving: bool, found: Floats) -> None:
    """Add the energies in J to ``found``: kinetic, of contacts, of bonds; at the time that velocities belong to.

    What contacts dissipate and walls do since the last force evaluation, after which nothing is booked, follows: the
    losses of dashpots, sliding, rolling, stiffening and yielding, the work of walls and of a box that is stretched.

    Parameters
    ----------
    world : World
    moving : bool
        Whether a step was taken; else nothing has moved since the forces.
    found : (10,) float64
        Zeros.
    """
    back = -LAG * world.numbers.dt
    time = SINCE_FORCES * world.numbers.dt - back if moving else 0.0
    scratch = np.empty(max(BOND_SCRATCH, HISTORY_BASE + HISTORY + 1) * LANES)
    active = np.empty(LANES, np.uint32)
    poses, wall_poses = world.particles.pose.copy(), world.walls.pose.copy()
    if LAG != 0.0:
        go_back(world, scratch, back)
    found[0] = kinetic_energy(world.particles, world.numbers.dt)
    found[1], found[2] = elastic_energies(world, active, scratch, time, found[LATEST:])
    for w in range(len(world.walls.shape_kind)):
        found[LATEST + WALLS_DID] -= time * power_on_wall(world.walls, w)
    if STRETCHES:
        found[LATEST + BOX_DID] += time * world.ledger[:, BOX_POWER].sum()
    if LAG != 0.0:
        world.particles.pose[:] = poses
        world.walls.pose[:] = wall_poses
        if STRETCHES:
            stretch_box(box_of(world.particles), time_now(world))


@inlined
def elastic_energies(world: World, active: Indices, scratch: Floats, time: float, lost: Floats) -> tuple[float, float]:
    """Return the elastic energies of contacts and of bonds, some time after the last force evaluation; add losses."""
    particles, numbers, contacts, bonds = world.particles, world.numbers, 0.0, 0.0
    if CONTACTS:
        contacts = energy_of_pairs(particles, world.pairs, world.bonds, numbers, active, scratch, time, lost)
    if WALLS:
        for p in range(len(world.wall_pairs.wall)):
            contacts += wall_energy(particles, world.walls, world.wall_pairs, numbers, p, time, lost)
    if BONDS:
        bonds = energy_of_bonds(particles, world.bonds, numbers, scratch, time)
    return contacts, bonds


@inlined
def kinetic_energy(particles: Particles, dt: float) -> float:
    """Return the kinetic energy in J of all particles that forces can move, scaled masses included.

    Taken as ½ m (v − ½ a dt)·(v + ½ a dt): the mean velocities of the steps before and after. A vibration whose period
    spans few steps keeps its energy in this form; ½ m v² alone exceeds it by (ω dt)²/4. Schemes with several force
    evaluations a step keep ½ m v² itself.
    """
    twist, change, body, total = particles.twist, particles.acceleration, particles.body, 0.0
    for k in range(len(twist)):
        for inverse, first in ((INVERSE_MASS, V), (INVERSE_INERTIA, W)):
            if body[k, inverse] > 0.0:
                v, half = row(twist, k, first), scale(half_kick(dt), row(change, k, first))
                total += 0.5 / body[k, inverse] * (dot(v, v) - dot(half, half))
    return total


@routine
def energy_of_bonds(particles: Particles, bonds: Bonds, numbers: Numbers, scratch: Floats, time: float) -> float:
    """Return the elastic energy of all bonds; those that let go slowly count with the share of load they have left.

    Strains that are summed up over the steps are taken on to the time of the positions, and not kept.
    """
    total, uniforms = 0.0, read_uniforms(numbers.bond_uniforms)
    for b in range(len(bonds.first)):
        data = bonds.data[b]
        for lane in range(LANES):
            gather_ends(particles, bonds.first[b, lane], bonds.second[b, lane], scratch, lane)
        for lane in range(LANES):  # always all: a loop of fixed length vectorises
            energy_of_lane(data, scratch, lane, uniforms, time)
        for lane in range(LANES):
            if bonds.sides[b, lane] & FIRST and data[INTACT * LANES + lane] > 0.0:
                total += data[INTACT * LANES + lane] * scratch[ENERGY * LANES + lane]
    return total


@inlined
def energy_of_lane(data: Floats, scratch: Floats, lane: int, uniforms: tuple[float, ...], time: float) -> None:
    """Write the elastic energy of a lane's bond some time after its forces were evaluated."""
    motion = read_motion(scratch, lane)
    strain, _, _ = bond_measure(motion, read_reference(data, lane), read_kinematic_state(data, lane), time)
    constants = read_constants(uniforms, data, lane)
    state = bond_flow(strain, constants, read_bond_state(data, lane))
    scratch[ENERGY * LANES + lane] = bond_energy(strain, constants, state)


@inlined
def energy_of(touch: Touch, constants, history, time: float, drag: Drag):  # type: ignore[no-untyped-def]
    """Return the elastic energy of a contact some time after its forces were evaluated, and what it has lost since."""
    since = no_losses()
    if time > 0.0:
        load, kept = contact_load(touch, constants, history, time, CHOICES)
        if CONTACT_LOSSES:
            since = contact_losses(touch, constants, history, load, kept, time, CHOICES, drag)
        history = kept
    return contact_energy(touch, constants, history, CHOICES), since


@routine
def energy_of_pairs(
    particles: Particles,
    pairs: Pairs,
    bonds: Bonds,
    numbers: Numbers,
    active: Indices,
    scratch: Floats,
    time: float,
    lost: Floats,
) -> float:
    """Return the elastic energy of all touching pairs, in blocks of lanes; add what they have lost."""
    count, total = 0, 0.0
    for k in range(len(pairs.first)):
        counts = meet(particles, pairs, k, numbers, scratch, count) and pairs.sides[k] & FIRST != 0
        if not BONDED_PAIRS_TOUCH:
            counts = counts and not joined(pairs, bonds, k)
        active[count] = k
        count += 1 if counts else 0
        if count == LANES:
            total = add_block(particles, pairs, numbers, active, count, scratch, time, total, lost)
            count = 0
    return add_block(particles, pairs, numbers, active, count, scratch, time, total, lost)


@routine
def add_block(
    particles: Particles,
    pairs: Pairs,
    numbers: Numbers,
    active: Indices,
    count: int,
    scratch: Floats,
    time: float,
    total: float,
    lost: Floats,
) -> float:
    """Return a total with the energies of one block of touching pairs added; add what they have lost."""
    for lane in range(count):
        gather(particles, pairs, active[lane], numbers, scratch, lane)
    material = int(particles.body[0, MATERIAL])
    shared = row_constants(numbers.contact_table[material, material])
    for lane in range(LANES):  # always all: a loop of fixed length vectorises
        energy_of_pair(scratch, lane, shared, numbers, time)
    for lane in range(count):
        total += scratch[CONTACT_ENERGY * LANES + lane]
        for term in range(5):
            lost[term] += scratch[(LOST + term) * LANES + lane]
    return total


@inlined
def energy_of_pair(scratch: Floats, lane: int, shared: Any, numbers: Numbers, time: float) -> None:
    """Write the elastic energy of a lane's contact some time after its forces were evaluated, and what it has lost."""
    touch, _, _, share = read_touch(scratch, lane, numbers, time)
    constants = shared if ONE_MATERIAL else read_contact_constants(scratch, CONTACT_FREE, lane)
    history = read_history(scratch, HISTORY_BASE, lane)
    if HISTORY > 0:
        spin = 0.5 * (dot(touch.spin_i, touch.normal) + dot(touch.spin_j, touch.normal)) * time
        history = carry_history(history, vector(scratch, NORMAL, lane), touch.normal, spin)
    drag = read_drag(scratch, lane) if CONTACT_LOSSES else NO_DRAG
    scratch[CONTACT_ENERGY * LANES + lane], since = energy_of(touch, constants, history, time, drag)
    scratch[LOST * LANES + lane] = since.viscous / share
    scratch[(LOST + 1) * LANES + lane] = since.sliding
    scratch[(LOST + 2) * LANES + lane] = since.rolling
    scratch[(LOST + 3) * LANES + lane] = since.stiffening
    scratch[(LOST + 4) * LANES + lane] = since.plastic if YIELDS else 0.0


@inlined
def wall_energy(
    particles: Particles, walls: Walls, pairs: WallPairs, numbers: Numbers, p: int, time: float, lost: Floats
) -> float:
    """Return the elastic energy of a particle and a wall, 0 where they do not touch."""
    w, k = pairs.wall[p], pairs.particle[p]
    near = place_on_wall(particles, walls, pairs, p, farthest(particles, walls, numbers, k, w))
    radius = particles.pose[k, RADIUS]
    if apart(particles, walls, pairs, numbers, p, near):
        return 0.0
    lever = radius - numbers.lever * (radius - near.distance)
    held = pairs.touching[p] != 0
    touch, share = wall_touch(particles, walls, numbers, k, w, near, lever, held, time)
    history = fresh_history()
    if HISTORY > 0 and held:
        spin = 0.5 * dot(touch.spin_i, near.normal) * time
        history = carry_history(load_history(pairs.history[p]), row(pairs.history, p, 0), near.normal, spin)
    constants = wall_constants(particles, walls, numbers, k, w)
    drag = kept_drag(pairs.history, p) if CONTACT_LOSSES and held else NO_DRAG
    energy, since = energy_of(touch, constants, history, time, drag)
    lost[VISCOUS] += since.viscous / share
    lost[SLIDING] += since.sliding
    lost[ROLLING] += since.rolling
    lost[STIFFENING] += since.stiffening
    if YIELDS:
        lost[YIELDED] += since.plastic
    return energy  # type: ignore[no-any-return]
