"""Where everything was a moment ago."""

from __future__ import annotations

from clast.engine.compiler import inlined
from clast.engine.state import Floats, World

from .layout import STEP
from .motion import drift, turn_all
from .slots import ORIENTATION, STRETCHES
from .stretching import stretch_box


@inlined
def go_back(world: World, scratch: Floats, time: float) -> None:
    """Move everything to where it was some time ago, no longer than velocities have been what they are."""
    particles, walls = world.particles, world.walls
    for k in range(len(particles.pose)):
        drift(particles, k, -time)
    if ORIENTATION:
        turn_all(particles, 0, len(particles.pose), scratch, -time)
    for w in range(len(walls.shape_kind)):
        for c in range(3):
            walls.displacement[w, c] -= time * walls.velocity[w, c]
    if STRETCHES:
        numbers = world.numbers
        now = numbers.first_time + (world.clock[STEP] - numbers.first_step) * numbers.dt
        stretch_box(particles.box, now - time)
