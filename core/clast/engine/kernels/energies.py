"""Elastic energies, at the positions of the full step: state functions of the laws, computed when asked."""

from __future__ import annotations

import numpy as np

from clast.engine.compiler import compiled, inlined
from clast.engine.state import Floats, Pairs, Particles, WallPairs, Walls, World
from clast.maths.vec3 import dot, sub
from clast.parts.contact_law import Touch

from .bond_lane import gather as gather_ends
from .bond_lane import read_motion
from .contact_lane import HISTORY_BASE, gather, read_touch
from .contact_sweep import joined, meet
from .lanes import row, vector
from .layout import BOND_SCRATCH, FIRST, INTACT, LANES, MATERIAL, NORMAL, RADIUS, X
from .slots import (
    BONDED_PAIRS_TOUCH,
    BONDS,
    CHOICES,
    CONTACTS,
    HISTORY,
    STAGES,
    WALLS,
    bond_energy,
    bond_flow,
    bond_measure,
    carry_history,
    contact_energy,
    contact_load,
    fresh_history,
    load_history,
    read_bond_state,
    read_constants,
    read_history,
    read_kinematic_state,
    read_reference,
    read_uniforms,
    row_constants,
    wall_nearest,
)
from .wall_sweep import wall_touch

SINCE_FORCES = STAGES[len(STAGES) - 1].drift_after
"""Time since the last force evaluation when a step is over, as a fraction of the step."""


@compiled
def energies(world: World, moving: bool, found: Floats) -> None:
    """Write the elastic energies in J into ``found``: of contacts, and of bonds.

    Parameters
    ----------
    world : World
    moving : bool
        Whether a step was taken; else nothing has moved since the forces.
    found : (2,) float64
    """
    time = SINCE_FORCES * world.numbers.dt if moving else 0.0
    scratch = np.empty(max(BOND_SCRATCH, HISTORY_BASE + HISTORY + 1) * LANES)
    found[0] = found[1] = 0.0
    if CONTACTS:
        for k in range(len(world.pairs.first)):
            found[0] += pair_energy(world, world.pairs, k, scratch, time)
    if WALLS:
        for p in range(len(world.wall_pairs.wall)):
            found[0] += wall_energy(world, world.walls, world.wall_pairs, world.particles, p, time)
    if BONDS:
        found[1] = energy_of_bonds(world, scratch)


@inlined
def energy_of_bonds(world: World, scratch: Floats) -> float:
    """Return the elastic energy of all bonds; those that let go slowly count with the share of load they have left."""
    bonds, total = world.bonds, 0.0
    uniforms = read_uniforms(world.numbers.bond_uniforms)
    for b in range(len(bonds.first)):
        data = bonds.data[b]
        for lane in range(LANES):
            share = data[INTACT * LANES + lane]
            if share == 0.0 or not bonds.sides[b, lane] & FIRST:
                continue
            gather_ends(world.particles, bonds.first[b, lane], bonds.second[b, lane], scratch, lane)
            motion = read_motion(scratch, lane)
            strain, _, _ = bond_measure(motion, read_reference(data, lane), read_kinematic_state(data, lane), 0.0)
            constants = read_constants(uniforms, data, lane)
            state = bond_flow(strain, constants, read_bond_state(data, lane))
            total += share * bond_energy(strain, constants, state)
    return total


@inlined
def energy_of(touch: Touch, constants, history, time: float) -> float:  # type: ignore[no-untyped-def]
    """Return the elastic energy of a contact some time after its forces were evaluated."""
    if time > 0.0:
        _, history = contact_load(touch, constants, history, time, CHOICES)
    return contact_energy(touch, constants, history, CHOICES)  # type: ignore[no-any-return]


@inlined
def pair_energy(world: World, pairs: Pairs, k: int, scratch: Floats, time: float) -> float:
    """Return the elastic energy of pair k, 0 where it does not touch."""
    particles, numbers = world.particles, world.numbers
    if not pairs.sides[k] & FIRST or not meet(particles, pairs, k, numbers, scratch, 0):
        return 0.0
    if not BONDED_PAIRS_TOUCH and joined(pairs, world.bonds, k):
        return 0.0
    gather(particles, pairs, k, numbers, scratch, 0)
    touch, _, _, _ = read_touch(scratch, 0, numbers, time)
    history = read_history(scratch, HISTORY_BASE, 0)
    if HISTORY > 0:
        spin = 0.5 * (dot(touch.spin_i, touch.normal) + dot(touch.spin_j, touch.normal)) * time
        history = carry_history(history, vector(scratch, NORMAL, 0), touch.normal, spin)
    i, j = pairs.first[k], pairs.second[k]
    constants = row_constants(numbers.contact_table[int(particles.body[i, MATERIAL]), int(particles.body[j, MATERIAL])])
    return energy_of(touch, constants, history, time)


@inlined
def wall_energy(world: World, walls: Walls, pairs: WallPairs, particles: Particles, p: int, time: float) -> float:
    """Return the elastic energy of a particle and a wall, 0 where they do not touch."""
    numbers = world.numbers
    w, k = pairs.wall[p], pairs.particle[p]
    x = sub(row(particles.pose, k, X), row(walls.displacement, w, 0))
    near = wall_nearest(walls.shape_kind[w], walls.shape[w], x)
    radius = particles.pose[k, RADIUS]
    if near.distance >= radius:
        return 0.0
    lever = radius - numbers.lever * (radius - near.distance)
    touch, _ = wall_touch(particles, k, near.distance, near.normal, lever, row(walls.velocity, w, 0), time)
    history = fresh_history()
    if HISTORY > 0 and pairs.touching[p] != 0:
        spin = 0.5 * dot(touch.spin_i, near.normal) * time
        history = carry_history(load_history(pairs.history[p]), row(pairs.history, p, 0), near.normal, spin)
    constants = row_constants(numbers.contact_table[int(particles.body[k, MATERIAL]), walls.material[w]])
    return energy_of(touch, constants, history, time)
