"""Velocities, ways and forces of walls around a force evaluation."""

from __future__ import annotations

from clast.engine.compiler import inlined, routine
from clast.engine.state import Floats, Walls
from clast.maths.vec3 import dot
from clast.parts.wall import Pressed

from .lanes import row
from .layout import WALL_WORK
from .slots import ANSWERING, wall_answer, wall_start, wall_velocity


@routine
def start_walls(walls: Walls, time: float) -> None:
    """Give the walls the velocities they have before any force is known."""
    for w in range(len(walls.shape_kind)):
        v = wall_start(walls, w, time)
        for c in range(3):
            walls.velocity[w, c] = v[c]


@routine
def steer_walls(walls: Walls, mass: float, middle: float, span: float, since: float) -> None:
    """Give the walls the velocities that they keep for ``span`` seconds, to the next force evaluation.

    ``middle`` is the time half-way, in s: there a velocity stands best for the whole span. ``mass`` in kg is that of
    all particles, ``since`` the time since the forces before.
    """
    for w in range(len(walls.shape_kind)):
        if ANSWERING:
            pressed = Pressed(row(walls.force, w, 0), mass, row(walls.velocity, w, 0), span, since)
            v = wall_answer(walls, w, middle, pressed)
        else:
            v = wall_velocity(walls, w, middle, span)
        for c in range(3):
            walls.velocity[w, c] = v[c]


@routine
def move_walls(walls: Walls, drift_time: float, reach2: float) -> bool:
    """Move the walls over some time; tell whether one is too far from where its neighbours were searched."""
    stale = False
    for w in range(len(walls.shape_kind)):
        away2 = 0.0
        for c in range(3):
            walls.displacement[w, c] += drift_time * walls.velocity[w, c]
            away = walls.displacement[w, c] - walls.reference[w, c]
            away2 += away * away
        stale = stale or not away2 <= reach2
    return stale


@inlined
def book_wall_work(walls: Walls, span: float, book: Floats) -> None:
    """Book half of the work that walls do on the way from one force evaluation to the next, with the forces at one."""
    for w in range(len(walls.shape_kind)):
        book[WALL_WORK] -= 0.5 * span * dot(row(walls.force, w, 0), row(walls.velocity, w, 0))


@routine
def clear_wall_forces(walls: Walls) -> None:
    """Forget the forces and moments of the last evaluation."""
    for w in range(len(walls.shape_kind)):
        for c in range(3):
            walls.force[w, c] = 0.0
            walls.moment[w, c] = 0.0
        walls.pressing[w] = 0.0


@routine
def sum_wall_forces(walls: Walls) -> None:
    """Add the forces and moments of this step to the sums from which means are taken."""
    for w in range(len(walls.shape_kind)):
        for c in range(3):
            walls.force_sum[w, c] += walls.force[w, c]
            walls.moment_sum[w, c] += walls.moment[w, c]
        walls.pressing_sum[w] += walls.pressing[w]
