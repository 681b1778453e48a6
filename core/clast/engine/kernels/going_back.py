"""Where everything was a moment ago."""

from __future__ import annotations

from clast.engine.compiler import inlined
from clast.engine.state import Floats, World

from .images import box_of
from .layout import STEP
from .motion import drift, turn_all
from .slots import ORIENTATION, STRETCHES
from .stretching import stretch_box
from .wall_motion import carry_wall


@inlined
def time_now(world: World) -> float:
    """Return the time in s to which all steps that are over lead."""
    return world.numbers.first_time + (world.clock[STEP] - world.numbers.first_step) * world.numbers.dt  # type: ignore[no-any-return]


@inlined
def go_back(world: World, scratch: Floats, time: float) -> None:
    """Move everything to where it was some time ago, no longer than velocities have been what they are."""
    particles, walls = world.particles, world.walls
    for k in range(len(particles.pose)):
        drift(particles, k, -time)
    if ORIENTATION:
        turn_all(particles, 0, len(particles.pose), scratch, -time)
    for w in range(len(walls.shape_kind)):
        carry_wall(walls, w, -time)
    if STRETCHES:
        stretch_box(box_of(particles), time_now(world) - time)
