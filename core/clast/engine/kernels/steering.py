"""Damping of all particles together: what they do, summed up over the scene, and what follows for each.

Every chunk sums up its own particles, and every thread adds up the sums of all chunks in their order: the same bits for
any number of threads. In between the threads wait for each other.
"""

from __future__ import annotations

from typing import Any

from clast.engine.compiler import inlined, written_out
from clast.engine.state import Floats, Integers, Numbers, Particles, World
from clast.maths.vec3 import dot
from clast.parts.damping import Together

from .lanes import row
from .layout import DOWNHILL, FORCE, INVERSE_INERTIA, INVERSE_MASS, MOTION, POWER, F, M, V, W
from .motion import accelerate
from .slots import SPIN, STEERS, steering

ENDS = ((INVERSE_MASS, F, V), (INVERSE_INERTIA, M, W))


@inlined
def weigh(particles: Particles, begin: int, end: int, numbers: Numbers, time: float, book: Floats) -> None:
    """Compute the accelerations of a chunk; sum up what its particles do together."""
    power = motion = force = 0.0
    for k in range(begin, end):
        accelerate(particles, k, numbers, time)
        for inverse, pushed, moved in ENDS:
            if particles.body[k, inverse] > 0.0 and (pushed == F or SPIN):
                mass = 1.0 / particles.body[k, inverse]
                a, v = row(particles.acceleration, k, pushed), row(particles.twist, k, moved)
                power += mass * dot(a, v)
                motion += mass * dot(v, v)
                force += mass * dot(a, a)
    book[POWER], book[MOTION], book[FORCE] = power, motion, force


@inlined
def together(ledger: Floats, clock: Integers, dt: float) -> Together:
    """Return what all particles do together, from the sums of the chunks; count how long they go downhill."""
    power = motion = force = 0.0
    for c in range(len(ledger) - 1):
        power += ledger[c, POWER]
        motion += ledger[c, MOTION]
        force += ledger[c, FORCE]
    clock[DOWNHILL] = clock[DOWNHILL] + 1 if power > 0.0 else 0
    return Together(power, motion, force, clock[DOWNHILL], dt)


@written_out
def how_to_brake(world: World, clock: Integers) -> Any:
    """Return what the damping of motion is told in this step."""
    if STEERS:
        return steering(world.numbers.braking, together(world.ledger, clock, world.numbers.dt))
    return world.numbers.braking
