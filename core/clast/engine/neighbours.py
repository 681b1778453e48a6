"""Neighbour lists: when to make them, and how contacts keep their history through it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.engine.cache_lines import on_lines
from clast.engine.chunks import shared_out
from clast.engine.kernels.layout import (
    ANGLE,
    ARM,
    FIRST,
    INTACT,
    INVERSE_MASS,
    LANES,
    RADIUS,
    SPAN,
    SPAN_AT_SEARCH,
    V,
    X,
)
from clast.engine.near_pairs import near_pairs
from clast.engine.state import Bonds, Floats, Indices, Integers, Pairs, Particles, WallPairs, Walls
from clast.engine.tables import box_of, slot_view
from clast.engine.wall_frames import arms
from clast.errors import RunError
from clast.maths.box import Box
from clast.parts.neighbour_search import NeighbourSearch

NearWalls = Callable[..., None]
LEAST_SKIN = 0.1
"""Least way that a particle may go between two neighbour searches, as a share of the smallest radius."""
MOST_SLOTS = 64
"""Contacts that a particle can have with one wall at a time."""


class Skin(NamedTuple):
    """How wide neighbour lists reach beyond contact, a side: bounds in m, and the steps a particle should be free."""

    least: float
    most: float
    steps: float


def choose_skin(wanted: float | Literal["auto"], smallest: float) -> Skin:
    """Return the skin of the neighbour lists: as wanted, or between a tenth of the smallest radius and two, in m.

    A pair more costs about 3 ns a step, a search about 1 µs a particle; 400 steps between searches balance the two.
    """
    if not isinstance(wanted, str):
        return Skin(0.5 * wanted, 0.5 * wanted, 0.0)
    return Skin(LEAST_SKIN * smallest, 2.0 * smallest, 400.0)


def choose_slack(particles: Particles, skin: Skin, dt: float, room: float) -> Floats:
    """Return how far each particle may move before lists go stale, (n,) in m.

    A particle gets the way it makes in ``skin.steps`` steps, within the skin's bounds: the few fast fragments of a
    burst grain do not force a search every other step, and the many slow ones have short lists. ``room`` in m is what a
    periodic box allows.

    Raises
    ------
    RunError
        If that is less than the skin's least.
    """
    if room < skin.least:
        raise RunError(
            "a side of the periodic box has become so short that particles would meet each other in two images; end "
            "the run earlier, or begin with a larger box"
        )
    v = particles.twist[:, V : V + 3]
    way = skin.steps * dt * np.sqrt(np.einsum("ij,ij->i", v, v))
    return np.asarray(np.clip(way, skin.least, min(skin.most, room)))


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
    found = found[movable[found].any(axis=1)]
    rows, sides, begin = shared_out(chunks, found)
    found = found[rows]
    kept = np.nonzero(old.sides & FIRST)[0]
    before, now = key(old.first[kept], old.second[kept]), key(found[:, 0], found[:, 1])
    touching, history, rest = carried(before, now, old.touching[kept], old.history[kept], old.rest[kept])
    return on_lines(
        Pairs(
            found[:, 0].astype(np.uint32),
            found[:, 1].astype(np.uint32),
            sides,
            bond_places(bonds, found, begin),
            rest,
            touching,
            history,
            begin,
        )
    )


def find_wall_pairs(
    particles: Particles, walls: Walls, old: WallPairs, near_walls: NearWalls, slack: Floats, wall_slack: float
) -> WallPairs:
    """Return the particles that can come to touch a wall, with the history of those that were known."""
    near = np.zeros((len(walls.shape_kind), len(particles.pose)), np.uint8)
    near_walls(particles, walls, slack, wall_slack, near)
    wall, particle = np.argwhere(near).T
    rows = walls.slots[wall]
    wall, particle, slot = np.repeat(wall, rows), np.repeat(particle, rows), counted_out(rows)
    before = key(old.wall, old.particle.astype(np.int64) * MOST_SLOTS + old.slot)
    now = key(wall, particle * MOST_SLOTS + slot)
    touching, history = carried(before, now, old.touching, old.history)
    return WallPairs(wall.astype(np.uint32), particle.astype(np.uint32), slot.astype(np.uint32), touching, history)


def counted_out(counts: Integers) -> Integers:
    """Return 0, 1, … up to each of some counts, one after the other.

    >>> counted_out(np.array([1, 3, 2])).tolist()
    [0, 0, 1, 2, 0, 1]
    """
    return np.asarray(np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts))


def key(first: NDArray[Any], second: NDArray[Any]) -> Integers:
    """Return one rising number for each pair."""
    return first.astype(np.int64) << 32 | second.astype(np.int64)


def carried(old_key: Integers, new_key: Integers, *old: NDArray[Any]) -> list[NDArray[Any]]:
    """Return tables for the new pairs, with the rows of those that were known; the old keys rise."""
    new = [np.zeros((len(new_key), *table.shape[1:]), table.dtype) for table in old]
    if len(old_key) > 0:
        at = np.minimum(np.searchsorted(old_key, new_key), len(old_key) - 1)
        known = old_key[at] == new_key
        for table, before in zip(new, old, strict=True):
            table[known] = before[at[known]]
    return new


def bond_places(bonds: Bonds, pairs: Integers, begin: Indices) -> Integers:
    """Return where each pair's bond stands in its chunk's part of the bond table, −1 for pairs without one."""
    holds = slot_view(bonds, INTACT) == 1.0
    return np.concatenate(
        [
            _places(bonds, holds, slice(*bonds.begin[c : c + 2]), pairs[slice(*begin[c : c + 2])])
            for c in range(len(begin) - 1)
        ]
    )


def _places(bonds: Bonds, holds: NDArray[np.bool_], blocks: slice, pairs: Integers) -> Integers:
    place = np.full(len(pairs), -1, np.int64)
    standing = int(blocks.start) * LANES + np.nonzero(holds[blocks].ravel())[0]
    if len(standing) == 0 or len(pairs) == 0:
        return place
    i, j = bonds.first.ravel()[standing], bonds.second.ravel()[standing]
    bond_key = key(np.minimum(i, j), np.maximum(i, j))
    order = np.argsort(bond_key, kind="stable")
    wanted = key(pairs[:, 0], pairs[:, 1])
    at = np.minimum(np.searchsorted(bond_key[order], wanted), len(order) - 1)
    known = bond_key[order][at] == wanted
    place[known] = standing[order[at[known]]]
    return place


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
