"""Neighbour lists: what particles and walls can come to touch before lists go stale."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from clast.engine.histories import carried, key, pair_rows, with_room
from clast.engine.kernels.layout import ANGLE, ARM, INVERSE_MASS, RADIUS, SPAN, SPAN_AT_SEARCH, X
from clast.engine.near_pairs import near_pairs
from clast.engine.state import Bonds, Floats, Indices, Integers, Pairs, Particles, WallPairs, Walls
from clast.engine.tables import box_of
from clast.engine.wall_frames import arms
from clast.maths.box import Box
from clast.parts.neighbour_search import NeighbourSearch

NearWalls = Callable[..., None]
MOST_SLOTS = 64
"""Contacts that a particle can have with one wall at a time."""


def find_pairs(
    particles: Particles, chunks: Indices, bonds: Bonds, old: Pairs, search: NeighbourSearch, slack: Floats, box: Box
) -> Pairs:
    """Return all pairs that can come to touch while each moves by its slack, with the history of those known.

    Pairs of two prescribed particles, and particles that left, are left out: nothing could move them.
    """
    here = np.nonzero(particles.present)[0]
    position = np.ascontiguousarray(particles.pose[here, X : X + 3])
    reach = particles.pose[here, RADIUS] + slack[here]
    found = here[near_pairs(search, position, reach, box)]
    movable = particles.body[:, INVERSE_MASS] > 0.0
    if not movable.all():
        found = found[movable[found].any(axis=1)]
    return with_room(pair_rows(found, chunks, bonds, old, np.arange(len(old.first))))


def find_wall_pairs(
    particles: Particles, walls: Walls, old: WallPairs, near_walls: NearWalls, slack: Floats, wall_slack: float
) -> WallPairs:
    """Return the particles that can come to touch a wall, with the history of those that were known."""
    near = wall_contacts(particles, np.arange(len(particles.pose)), walls, near_walls, slack, wall_slack)
    return wall_rows(near, old)


def wall_contacts(
    particles: Particles, number: Integers, walls: Walls, near_walls: NearWalls, slack: Floats, wall_slack: float
) -> Integers:
    """Return a rising number for each contact that particles can come to have with walls, as ``key`` makes of them.

    Parameters
    ----------
    particles : tables
        Of the particles that are asked for, (k, …).
    number : (k,) int64
        Which those are.
    """
    near = np.zeros((len(walls.shape_kind), len(number)), np.uint8)
    near_walls(particles, walls, slack, wall_slack, near)
    wall, particle = np.argwhere(near).T
    rows = walls.slots[wall]
    return key(np.repeat(wall, rows), np.repeat(number[particle], rows) * MOST_SLOTS + counted_out(rows))


def known_wall_contacts(known: WallPairs) -> Integers:
    """Return the same numbers for the rows of a table."""
    return key(known.wall, known.particle.astype(np.int64) * MOST_SLOTS + known.slot)


def wall_rows(contacts: Integers, old: WallPairs) -> WallPairs:
    """Return the rows of contacts with walls, with the history of those that were known."""
    touching, history = carried(known_wall_contacts(old), contacts, old.touching, old.history)
    wall, (particle, slot) = contacts >> 32, np.divmod(contacts & 0xFFFFFFFF, MOST_SLOTS)
    return WallPairs(wall.astype(np.uint32), particle.astype(np.uint32), slot.astype(np.uint32), touching, history)


def counted_out(counts: Integers) -> Integers:
    """Return 0, 1, … up to each of some counts, one after the other.

    >>> counted_out(np.array([1, 3, 2])).tolist()
    [0, 0, 1, 2, 0, 1]
    """
    return np.asarray(np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts))


def remember_positions(particles: Particles, walls: Walls, slack: Floats) -> None:
    """Note where everything is and may go, so that the loop can tell when the lists go stale."""
    particles.reference[:, :3] = particles.pose[:, X : X + 3]
    particles.reference[:, 3] = slack * slack
    box = box_of(particles)
    if box is not None:
        box[SPAN_AT_SEARCH] = box[SPAN]
    walls.reference[:, :3] = walls.displacement
    if walls.reference.shape[1] > 3:
        walls.reference[:, ANGLE] = 0.0
        walls.reference[:, ARM] = arms(walls, particles, particles.pose[:, RADIUS] + slack)
