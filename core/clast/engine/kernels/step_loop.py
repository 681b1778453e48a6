"""The step loop: from one event to the next without leaving compiled code."""

from __future__ import annotations

import numpy as np

from clast.engine.compiler import compiled, routine
from clast.engine.state import Indices, World
from clast.parts.integrator import Stage

from .bond_sweep import sweep_bonds
from .contact_sweep import sweep_contacts
from .layout import DONE, LANES, MOVED, PRIMED, STAGE, STALE, STEP
from .motion import (
    clear_wall_forces,
    move_after_forces,
    move_before_forces,
    move_walls,
    sum_wall_forces,
    walls_strayed,
)
from .slots import BONDS, CONTACTS, SPANS, STAGES, WALLS
from .wall_sweep import sweep_walls


@routine
def compute_forces(world: World, active: Indices, dt: float) -> None:
    """Add the loads of bonds, contacts and walls at the present positions."""
    particles, numbers = world.particles, world.numbers
    if BONDS:
        sweep_bonds(world.bonds, particles, world.cracks, numbers, world.scratch, dt, world.clock[STEP])
    if CONTACTS:
        sweep_contacts(world.pairs, world.bonds, particles, numbers, world.scratch, active, dt)
    if WALLS:
        clear_wall_forces(world.walls)
        sweep_walls(world.walls, world.wall_pairs, particles, numbers, dt)


@routine
def prime(world: World, active: Indices) -> None:
    """Compute the accelerations at the start, which predictors and first kicks need; nothing moves."""
    particles, numbers = world.particles, world.numbers
    move_before_forces(particles, Stage(0.0, 0.0, 0.0, 0.0, 0.0), numbers)
    if WALLS:
        move_walls(world.walls, 0.0, 0.0)
    compute_forces(world, active, 2.0 * numbers.start_kick * numbers.dt)
    move_after_forces(particles, Stage(0.0, 0.0, 0.0, numbers.start_kick, 0.0), numbers, 0.0)


@compiled
def advance(world: World, steps: int) -> int:
    """Advance the world to step number ``steps``, or until its neighbour lists are stale.

    Returns DONE or STALE; after STALE the caller makes new lists and calls again, and the step goes on where it was.
    """
    particles, numbers, clock = world.particles, world.numbers, world.clock
    active = np.empty(LANES, np.uint32)
    if clock[PRIMED] == 0:
        prime(world, active)
        clock[PRIMED] = 1
    while clock[STEP] < steps:
        while clock[STAGE] < len(STAGES):
            stage = STAGES[0 if len(STAGES) == 1 else clock[STAGE]]
            time = clock[STEP] * numbers.dt
            if clock[MOVED] == 0:
                stale = move_before_forces(particles, stage, numbers)
                if WALLS:
                    move_walls(world.walls, time, stage.drift_before * numbers.dt)
                    stale = walls_strayed(world.walls, numbers.reach2) or stale
                clock[MOVED] = 1
                if stale:
                    return STALE
            compute_forces(world, active, SPANS[clock[STAGE]] * numbers.dt)
            move_after_forces(particles, stage, numbers, time)
            if WALLS:
                move_walls(world.walls, time, stage.drift_after * numbers.dt)
            clock[MOVED] = 0
            clock[STAGE] += 1
        if WALLS:
            sum_wall_forces(world.walls)
        clock[STAGE] = 0
        clock[STEP] += 1
    return DONE
