"""Where particles touch walls: in one place, or in several, each of which keeps its row from step to step."""

from __future__ import annotations

from math import inf

from clast.engine.compiler import inlined, routine
from clast.engine.state import Floats, Particles, WallPairs, Walls
from clast.maths.vec3 import dot
from clast.parts.wall import Nearest

from .lanes import row
from .layout import RADIUS, X
from .slots import MANIFOLDS, REMEMBERS, WALLS_TURN, wall_nearest, wall_touches
from .wall_frames import into_space, seen_from_wall

STEADY = 0.9
"""Cosine of the angle by which the normal of a contact may turn between two force evaluations."""


@inlined
def place_on_wall(particles: Particles, walls: Walls, pairs: WallPairs, p: int, beyond: float) -> Nearest:
    """Return distance and direction of the contact of row p, infinitely far where it has none.

    The rows of a particle at a wall that it can touch in several places must be asked one after the other, from the
    first on: that one finds all places, no farther than ``beyond`` from touch.
    """
    w, k = pairs.wall[p], pairs.particle[p]
    if MANIFOLDS and walls.slots[w] > 1:
        if pairs.slot[p] == 0:
            share_out(particles, walls, pairs, p, particles.pose[k, RADIUS] + beyond)
        place = walls.places[pairs.slot[p]]
        return Nearest(place[0], (place[1], place[2], place[3]))
    near: Nearest = wall_nearest(walls, w, seen_from_wall(walls, w, row(particles.pose, k, X)))
    return Nearest(near.distance, into_space(walls, w, near.normal))


@routine
def share_out(particles: Particles, walls: Walls, pairs: WallPairs, first: int, reach: float) -> None:
    """Find all places where a particle touches a wall, and give each to one of its rows from ``first`` on.

    A place goes to the row whose contact had nearly its normal, those that agree best first; all others to rows that
    are free.
    """
    w, k = pairs.wall[first], pairs.particle[first]
    slots = walls.slots[w]
    given, found = walls.places[:slots], walls.places[slots : 2 * slots + 1]
    for s in range(slots):
        given[s, 0] = inf
    count = wall_touches(walls, w, seen_from_wall(walls, w, row(particles.pose, k, X)), reach, found)
    if WALLS_TURN:
        for c in range(min(count, slots + 1)):
            turn_into_space(walls, w, found[c])
    if count > slots:
        if found[slots, 0] < particles.pose[k, RADIUS]:
            walls.crowded[w] = 1
        count = slots
    if REMEMBERS:
        for _ in range(count):
            s, c = best_match(pairs, first, given, found, count)
            if s < 0:
                break
            hand_over(given[s], found[c])
    s = 0
    for c in range(count):
        if found[c, 0] < inf:
            while s < slots and (given[s, 0] < inf or (REMEMBERS and pairs.touching[first + s] != 0)):
                s += 1
            if s < slots:
                hand_over(given[s], found[c])


@inlined
def turn_into_space(walls: Walls, w: int, place: Floats) -> None:
    """Give the normal of a place in space that was found in the frame of wall w."""
    normal = into_space(walls, w, (place[1], place[2], place[3]))
    for c in range(3):
        place[1 + c] = normal[c]


@inlined
def best_match(pairs: WallPairs, first: int, given: Floats, found: Floats, count: int) -> tuple[int, int]:
    """Return the row and the place, both still free, whose normals agree best; −1 where none do."""
    best, row_found, place_found = STEADY, -1, -1
    for s in range(len(given)):
        if pairs.touching[first + s] != 0 and given[s, 0] == inf:
            for c in range(count):
                if found[c, 0] < inf:
                    agreement = dot(row(pairs.history, first + s, 0), row(found, c, 1))
                    if agreement > best:
                        best, row_found, place_found = agreement, s, c
    return row_found, place_found


@inlined
def hand_over(given: Floats, found: Floats) -> None:
    """Copy a place, and take it off those that are found."""
    for c in range(4):
        given[c] = found[c]
    found[0] = inf
