"""The step loop: from one event to the next without leaving compiled code.

Several threads may run it together, each with its share of the chunks; they wait for each other where one reads what
others write. Walls and the clock belong to the first thread.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.engine.barrier import wait
from clast.engine.compiler import compiled, inlined
from clast.engine.state import Indices, Integers, Numbers, Team, World
from clast.parts.integrator import Stage

from .bond_sweep import sweep_bonds
from .contact_sweep import sweep_contacts
from .images import box_of
from .layout import BOX_POWER, DONE, LANES, MOVED, PRIMED, STAGE, STALE, STEP
from .motion import move_after_forces, move_before_forces
from .slots import BONDS, CHUNKED, CONTACTS, FORCES_AT, SPANS, STAGES, STEERS, STRETCHES, WALLS
from .steering import how_to_brake, weigh
from .stretching import book_box_work, stretch_box
from .wall_motion import book_wall_work, clear_wall_forces, move_walls, start_walls, steer_walls, sum_wall_forces
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
def time_since_forces(clock: Integers, numbers: Numbers) -> float:
    """Return the time since the last force evaluation in s.

    The first step follows the forces at the start, so only its own first drift has passed by then.
    """
    if clock[PRIMED] == 0:
        return 2.0 * numbers.start_kick * numbers.dt
    if clock[STEP] == 0 and clock[STAGE] == 0 and numbers.start_kick == 0.0:
        return STAGES[0].drift_before * numbers.dt
    span = SPANS[clock[STAGE]] * numbers.dt
    if clock[STEP] == numbers.first_step and clock[STAGE] == 0:
        span += numbers.late
    return span


@inlined
def since_walls_were_told(clock: Integers, numbers: Numbers, span: float) -> float:
    """Return twice the time in s since walls had the velocity that they were given, in the middle of a span.

    That is the time since the forces before, but where the step was just changed and the span was not what they were
    told.
    """
    return span - numbers.early if clock[STEP] == numbers.first_step and clock[STAGE] == 0 else span


@inlined
def until_next_forces(clock: Integers) -> tuple[float, float]:
    """Return when forces are evaluated now, and the time to their next evaluation, as fractions of the step."""
    if clock[PRIMED] == 0:
        return 0.0, STAGES[0].drift_before
    stage = clock[STAGE]
    return FORCES_AT[stage], SPANS[(stage + 1) % len(SPANS)]


@inlined
def time_of_forces(clock: Integers, numbers: Numbers) -> float:
    """Return the time in s at which forces are evaluated now."""
    at, _ = until_next_forces(clock)
    return numbers.first_time + (clock[STEP] - numbers.first_step + at) * numbers.dt  # type: ignore[no-any-return]


@inlined
def count_stage(clock: Integers) -> bool:
    """Note that a stage is over; tell whether the step is."""
    clock[MOVED] = 0
    if clock[PRIMED] == 0:
        clock[PRIMED] = 1
        return False
    clock[STAGE] += 1
    if clock[STAGE] < len(STAGES):
        return False
    clock[STAGE] = 0
    clock[STEP] += 1
    return True


@inlined
def move_to_forces(world: World, begin: int, end: int, first: bool, stage: Stage, time: float, span: float) -> None:
    """Move the chunks from ``begin`` to ``end``, and the walls, to where forces are evaluated at a time."""
    numbers, chunks = world.numbers, world.chunks
    for c in range(begin, end):
        moved_on = move_before_forces(world.particles, chunks[c], chunks[c + 1], stage, numbers, world.scratch[c], time)
        world.stale[c] = 1 if moved_on else 0
    if STRETCHES and first:
        stretch_box(box_of(world.particles), time)
    if WALLS and first:
        if world.clock[PRIMED] == 0:
            start_walls(world.walls, time)
        moved_on = move_walls(world.walls, stage.drift_before * numbers.dt, numbers.wall_reach2)
        world.stale[-1] = 1 if moved_on else 0
        book_wall_work(world.walls, span, world.ledger[-1])
        clear_wall_forces(world.walls)


@inlined
def sweep_chunks(world: World, begin: int, end: int, active: Indices, span: float, step: int) -> None:
    """Add the loads of bonds and contacts to the particles of the chunks from ``begin`` to ``end``."""
    particles, numbers = world.particles, world.numbers
    for c in range(begin, end):
        if STRETCHES:
            book_box_work(world.ledger[c], span)
            world.ledger[c, BOX_POWER] = 0.0
        if BONDS:
            sweep_bonds(world.bonds, c, particles, world.cracks, numbers, world.scratch[c], world.ledger[c], span, step)
        if CONTACTS:
            sweep_contacts(
                world.pairs, c, world.bonds, particles, numbers, world.scratch[c], active, world.ledger[c], span
            )
        if STRETCHES:
            book_box_work(world.ledger[c], span)


@inlined
def weigh_chunks(world: World, begin: int, end: int, time: float) -> None:
    """Compute the accelerations of the chunks from ``begin`` to ``end``, and what a damping asks of them together."""
    for c in range(begin, end):
        weigh(world.particles, world.chunks[c], world.chunks[c + 1], world.numbers, time, world.ledger[c])


@inlined
def move_from_forces(
    world: World, begin: int, end: int, first: bool, stage: Stage, time: float, span: float, how: Any
) -> None:
    """Move the chunks from ``begin`` to ``end``, and the walls, to the end of the stage."""
    numbers, chunks = world.numbers, world.chunks
    for c in range(begin, end):
        scratch, book = world.scratch[c], world.ledger[c]
        move_after_forces(world.particles, chunks[c], chunks[c + 1], stage, numbers, scratch, time, how, book)
    if STRETCHES and first:
        at, _ = until_next_forces(world.clock)
        stretch_box(box_of(world.particles), time + (at + stage.drift_after) * numbers.dt)
    if WALLS and first:
        at, span_on = until_next_forces(world.clock)
        if span_on > 0.0:
            middle = time + (at + 0.5 * span_on) * numbers.dt
            since = since_walls_were_told(world.clock, numbers, span)
            steer_walls(world.walls, numbers.mass, middle, span_on * numbers.dt, since)
        move_walls(world.walls, stage.drift_after * numbers.dt, numbers.wall_reach2)


@compiled
def advance(world: World, steps: int, team: Team) -> int:
    """Advance the world to step number ``steps``, or until its neighbour lists are stale.

    Every thread of the team calls it and gets the same answer: DONE or STALE; after STALE the caller makes new lists
    and calls again, and the step goes on where it was.
    """
    numbers, first = world.numbers, team.rank == 0
    begin, end = team.begin, team.end
    active = np.empty(LANES, np.uint32)
    clock = world.clock if first else world.clock.copy()
    while clock[STEP] < steps or clock[PRIMED] == 0:
        stage = stage_now(clock, numbers.start_kick)
        time = numbers.first_time + (clock[STEP] - numbers.first_step) * numbers.dt
        span = time_since_forces(clock, numbers)
        if clock[MOVED] == 0:
            then = time
            if STRETCHES:
                then = time_of_forces(clock, numbers)
            move_to_forces(world, begin, end, first, stage, then, span)
            if CHUNKED:
                wait(team)
            clock[MOVED] = 1
            if world.stale.any():
                return STALE
        sweep_chunks(world, begin, end, active, span, clock[STEP])
        if WALLS:
            if CHUNKED:
                wait(team)
            if first:
                sweep_walls(world.walls, world.wall_pairs, world.particles, numbers, world.ledger[-1], span)
        if CHUNKED:
            wait(team)
        if STEERS:
            weigh_chunks(world, begin, end, time)
            if CHUNKED:
                wait(team)
        how = how_to_brake(world, clock)
        move_from_forces(world, begin, end, first, stage, time, span, how)
        if count_stage(clock) and WALLS and first:
            sum_wall_forces(world.walls)
    return DONE
