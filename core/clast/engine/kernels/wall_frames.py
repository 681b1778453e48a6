"""The frames of walls: places and directions seen from a wall and back, and how its surface moves.

A wall's own frame is the scene at the start. It moves with the displacement, and turns about the wall's centre.
"""

from __future__ import annotations

from clast.engine.compiler import inlined
from clast.engine.state import Walls
from clast.maths.rotation import Matrix, Quat, matrix, rotate, rotate_back
from clast.maths.vec3 import ZERO, Vec, add, cross, dot, sub

from .lanes import row
from .layout import WALL_Q, WALL_W
from .slots import WALLS_TURN


@inlined
def orientation(walls: Walls, w: int) -> Quat:
    """Return how wall w is turned."""
    pose = walls.pose
    return (pose[w, WALL_Q], pose[w, WALL_Q + 1], pose[w, WALL_Q + 2], pose[w, WALL_Q + 3])


@inlined
def turned_by(walls: Walls, w: int) -> Matrix:
    """Return the matrix that takes directions in the frame of wall w into space."""
    return matrix(orientation(walls, w))


@inlined
def from_centre(walls: Walls, w: int, x: Vec) -> Vec:
    """Return the way to x from the centre of wall w, wherever that is now."""
    return sub(sub(x, row(walls.pose, w, 0)), row(walls.centre, w, 0))


@inlined
def seen_from_wall(walls: Walls, w: int, x: Vec) -> Vec:
    """Return the place x in the frame of wall w."""
    if WALLS_TURN:
        return add(row(walls.centre, w, 0), rotate_back(turned_by(walls, w), from_centre(walls, w, x)))
    return sub(x, row(walls.pose, w, 0))


@inlined
def into_space(walls: Walls, w: int, direction: Vec) -> Vec:
    """Return a direction that is given in the frame of wall w."""
    return rotate(turned_by(walls, w), direction) if WALLS_TURN else direction


@inlined
def spin_of_wall(walls: Walls, w: int) -> Vec:
    """Return the angular velocity of wall w."""
    return row(walls.twist, w, WALL_W) if WALLS_TURN else ZERO


@inlined
def velocity_of_wall(walls: Walls, w: int, x: Vec) -> Vec:
    """Return the velocity of wall w at the place x."""
    velocity = row(walls.twist, w, 0)
    if WALLS_TURN:
        velocity = add(velocity, cross(spin_of_wall(walls, w), from_centre(walls, w, x)))
    return velocity


@inlined
def power_on_wall(walls: Walls, w: int) -> float:
    """Return the power of what presses on wall w, in W."""
    power = dot(row(walls.force, w, 0), row(walls.twist, w, 0))
    if WALLS_TURN:
        power += dot(row(walls.moment, w, 0), spin_of_wall(walls, w))
    return power
