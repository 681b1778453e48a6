"""The step loop: from one event to the next without leaving compiled code."""

from __future__ import annotations

import numpy as np

from clast.engine.compiler import compiled, inlined
from clast.engine.state import Integers, World
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
)
from .slots import BONDS, CONTACTS, SPANS, STAGES, WALLS
from .wall_sweep import sweep_walls


@inlined
def stage_now(clock: Integers, start_kick: float) -> Stage:
    """Return the stage that is due; before the first step, one that moves nothing and only computes forces.

    Predictors and first kicks need the accelerations at the start.
    """
    if clock[PRIMED] == 0:
        return Stage(0.0, 0.0, 0.0, start_kick, 0.0)
    return STAGES[0 if len(STAGES) == 1 else clock[STAGE]]


@inlined
def time_since_forces(clock: Integers, start_kick: float) -> float:
    """Return the time since the last force evaluation, as a fraction of the step."""
    if clock[PRIMED] == 0:
        return 2.0 * start_kick
    return SPANS[clock[STAGE]]


@inlined
def count_stage(world: World) -> None:
    """Note that a stage is over, and with the last one the step."""
    clock = world.clock
    clock[MOVED] = 0
    if clock[PRIMED] == 0:
        clock[PRIMED] = 1
        return
    clock[STAGE] += 1
    if clock[STAGE] == len(STAGES):
        clock[STAGE] = 0
        clock[STEP] += 1
        if WALLS:
            sum_wall_forces(world.walls)


@compiled
def advance(world: World, steps: int) -> int:
    """Advance the world to step number ``steps``, or until its neighbour lists are stale.

    Returns DONE or STALE; after STALE the caller makes new lists and calls again, and the step goes on where it was.
    """
    particles, numbers, clock = world.particles, world.numbers, world.clock
    active = np.empty(LANES, np.uint32)
    while clock[STEP] < steps or clock[PRIMED] == 0:
        stage = stage_now(clock, numbers.start_kick)
        time = clock[STEP] * numbers.dt
        if clock[MOVED] == 0:
            stale = move_before_forces(particles, stage, numbers, world.scratch)
            if WALLS:
                stale = move_walls(world.walls, time, stage.drift_before * numbers.dt, numbers.wall_reach2) or stale
                clear_wall_forces(world.walls)
            clock[MOVED] = 1
            if stale:
                return STALE
        span = time_since_forces(clock, numbers.start_kick) * numbers.dt
        if BONDS:
            sweep_bonds(world.bonds, particles, world.cracks, numbers, world.scratch, span, clock[STEP])
        if CONTACTS:
            sweep_contacts(world.pairs, world.bonds, particles, numbers, world.scratch, active, span)
        if WALLS:
            sweep_walls(world.walls, world.wall_pairs, particles, numbers, span)
        move_after_forces(particles, stage, numbers, world.scratch, time)
        if WALLS:
            move_walls(world.walls, time, stage.drift_after * numbers.dt, numbers.wall_reach2)
        count_stage(world)
    return DONE
