"""Velocities, ways and forces of walls around a force evaluation."""

from __future__ import annotations

from math import sqrt

from clast.engine.compiler import inlined, routine
from clast.engine.state import Floats, Walls
from clast.maths.rotation import turn
from clast.maths.vec3 import ZERO, Vec, dot, sub
from clast.parts.motion import Pressed, Turned

from .lanes import row
from .layout import ANGLE, ARM, WALL_Q, WALL_W, WALL_WORK
from .slots import (
    ANSWERING,
    TURNED_BY_MOMENTS,
    WALLS_TURN,
    wall_answer,
    wall_answer_spin,
    wall_spin,
    wall_start,
    wall_start_spin,
    wall_velocity,
)
from .wall_frames import orientation, power_on_wall, spin_of_wall


@inlined
def give_velocity(walls: Walls, w: int, velocity: Vec, spin: Vec) -> None:
    """Give wall w a velocity and, where walls turn, an angular velocity."""
    for c in range(3):
        walls.twist[w, c] = velocity[c]
        if WALLS_TURN:
            walls.twist[w, WALL_W + c] = spin[c]


@routine
def start_walls(walls: Walls, time: float) -> None:
    """Give the walls the velocities they have before any force is known."""
    for w in range(len(walls.shape_kind)):
        spin = wall_start_spin(walls, w, time) if WALLS_TURN else ZERO
        give_velocity(walls, w, wall_start(walls, w, time), spin)


@routine
def steer_walls(walls: Walls, mass: float, middle: float, span: float, since: float) -> None:
    """Give the walls the velocities that they keep for ``span`` seconds, to the next force evaluation.

    ``middle`` is the time half-way, in s: there a velocity stands best for the whole span. ``mass`` in kg is that of
    all particles, ``since`` the time since the forces before.
    """
    for w in range(len(walls.shape_kind)):
        spin = ZERO
        if TURNED_BY_MOMENTS:
            turned = Turned(row(walls.moment, w, 0), orientation(walls, w), spin_of_wall(walls, w), span, since)
            spin = wall_answer_spin(walls, w, middle, turned)
        elif WALLS_TURN:
            spin = wall_spin(walls, w, middle)
        if ANSWERING:
            pressed = Pressed(row(walls.force, w, 0), mass, row(walls.twist, w, 0), span, since)
            give_velocity(walls, w, wall_answer(walls, w, middle, pressed), spin)
        else:
            give_velocity(walls, w, wall_velocity(walls, w, middle, span), spin)


@inlined
def carry_wall(walls: Walls, w: int, time: float) -> None:
    """Move and turn wall w with its velocities over some time."""
    pose = walls.pose
    for c in range(3):
        pose[w, c] += time * walls.twist[w, c]
    if WALLS_TURN:
        q = turn(orientation(walls, w), spin_of_wall(walls, w), time)
        for c in range(4):
            pose[w, WALL_Q + c] = q[c]


@inlined
def strayed_wall(walls: Walls, w: int, turned_for: float, reach2: float) -> bool:
    """Tell whether some place of wall w is too far from where it was as neighbours were searched.

    ``turned_for`` is the time over which it has turned since this was asked the last time.
    """
    away = sub(row(walls.pose, w, 0), row(walls.reference, w, 0))
    if WALLS_TURN:
        spin = spin_of_wall(walls, w)
        walls.reference[w, ANGLE] += abs(turned_for) * sqrt(dot(spin, spin))
        farthest = sqrt(dot(away, away)) + walls.reference[w, ANGLE] * walls.reference[w, ARM]
        return not farthest * farthest <= reach2
    return not dot(away, away) <= reach2


@routine
def move_walls(walls: Walls, drift_time: float, reach2: float) -> bool:
    """Move the walls over some time; tell whether one is too far from where its neighbours were searched."""
    stale = False
    for w in range(len(walls.shape_kind)):
        carry_wall(walls, w, drift_time)
        stale = strayed_wall(walls, w, drift_time, reach2) or stale
    return stale


@inlined
def book_wall_work(walls: Walls, span: float, book: Floats) -> None:
    """Book half of the work that walls do on the way from one force evaluation to the next, with the forces at one."""
    for w in range(len(walls.shape_kind)):
        book[WALL_WORK] -= 0.5 * span * power_on_wall(walls, w)


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
