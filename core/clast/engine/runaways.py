"""Runaways: the few particles that moved farther than neighbour lists foresaw, whose neighbours are searched alone.

A primary that has just come free leaves a place where nothing moved; in a bed that is crushed one does every twenty
steps, while all others have hardly begun to use up their way. Only its own rows are then made anew. Lists hold what
they did: every pair that can come to touch while each goes the way it has from where it was looked at last.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from clast.engine.chunks import home_of
from clast.engine.histories import key
from clast.engine.kernels.layout import ARM, INVERSE_MASS, RADIUS, SPAN, SPAN_AT_SEARCH, X
from clast.engine.neighbours import NearWalls, known_wall_contacts, wall_contacts, wall_rows
from clast.engine.state import Bytes, Floats, Indices, Integers, Pairs, Particles, WallPairs, Walls
from clast.engine.tables import box_of
from clast.engine.wall_frames import arms
from clast.maths.box import Box

ROUNDING = 1e-9
"""Share by which blocks are looked into that are a little too far away: their middles are rounded."""

BLOCK = 64
"""Particles of a block, which are looked at together or not at all."""

BASE, EACH = 1000, 1 / 300
"""What it costs to mend lists, in particles whose neighbours could be searched instead: in any case, and for each
runaway as a share of all."""


def runaways(particles: Particles, chunks: Indices, stale: Bytes) -> Integers:
    """Return which particles of stale chunks are farther from where they were looked at last than lists foresaw."""
    found = [np.zeros(0, np.int64)]
    for c in np.flatnonzero(stale[:-1]):
        here = slice(*chunks[c : c + 2])
        way = particles.pose[here, X : X + 3] - particles.reference[here, :3]
        gone = ~(np.einsum("ij,ij->i", way, way) <= particles.reference[here, 3])
        found.append(int(chunks[c]) + np.flatnonzero(gone))
    return np.concatenate(found)


def cost(away: Integers, particles: Particles, stale: Bytes) -> float:
    """Return what it costs to search the neighbours of some runaways alone, over what it costs to search all.

    Infinite if lists do not fit others either: no particle ran away, a wall moved, or the box has been stretched, and
    with it all images have moved. A scene of one chunk has no room for new pairs.
    """
    box, count = box_of(particles), len(particles.pose)
    still = box is None or bool((box[SPAN] == box[SPAN_AT_SEARCH]).all())
    fits = still and len(away) > 0 and not stale[-1] and len(stale) > 2
    return BASE / count + EACH * len(away) if fits else np.inf


class Extents(NamedTuple):
    """Boxes around the places from which particles go their way, (b, 3) in m, for each block of successive ones.

    Those of a grain have successive numbers, so most blocks are small.
    """

    lower: Floats
    upper: Floats

    def near(self, place: Floats, far: float, box: Box) -> Integers:
        """Return the particles of all blocks that have something within a distance of a place."""
        away = np.abs(box.nearest(0.5 * (self.lower + self.upper) - place)) - 0.5 * (self.upper - self.lower)
        blocks = np.flatnonzero((away < far * (1.0 + ROUNDING)).all(axis=1))
        return np.asarray(blocks[:, None] * BLOCK + np.arange(BLOCK)).ravel()

    def widen(self, particles: Particles, away: Integers) -> None:
        """Make room for the places from which some particles go their way now."""
        np.minimum.at(self.lower, away // BLOCK, particles.reference[away, :3])
        np.maximum.at(self.upper, away // BLOCK, particles.reference[away, :3])


def extents(particles: Particles) -> Extents:
    """Return the boxes of all blocks."""
    places, begin = particles.reference[:, :3], np.arange(0, len(particles.reference), BLOCK)
    return Extents(np.minimum.reduceat(places, begin), np.maximum.reduceat(places, begin))


def rows_of(particles: Particles, some: Integers) -> Particles:
    """Return the tables of some particles that searches read."""
    names = ("pose", "twist", "body", "reference", "present")
    return particles._replace(**{name: getattr(particles, name)[some] for name in names})


def look_again(particles: Particles, walls: Walls, away: Integers, slack: Floats) -> None:
    """Note where some particles are and may go, (k,) in m, as lists are made of them anew."""
    particles.reference[away, :3] = particles.pose[away, X : X + 3]
    particles.reference[away, 3] = slack * slack
    if walls.reference.shape[1] > 3:
        seen = rows_of(particles, away)
        farthest = arms(walls, seen, seen.pose[:, RADIUS] + slack)
        walls.reference[:, ARM] = np.maximum(walls.reference[:, ARM], farthest)


def pairs_of(particles: Particles, where: Extents, away: Integers, most: float, more: float, box: Box) -> Integers:
    """Return the pairs that some particles can come to make while each goes its way, (p, 2) with i < j, rising.

    Two are near if they can come closer than ``more`` in m beyond touch; no particle reaches farther than ``most``.
    Those that nothing could move are left out.
    """
    found = [np.zeros((0, 2), np.int64)]
    for i in away[particles.present[away] != 0].tolist():
        place, reach = particles.reference[i, :3], particles.pose[i, RADIUS] + np.sqrt(particles.reference[i, 3]) + more
        near = where.near(place, reach + most, box)
        near = near[(near != i) & (near < len(particles.pose))]
        way = box.nearest(particles.reference[near, :3] - place)
        far = reach + particles.pose[near, RADIUS] + np.sqrt(particles.reference[near, 3])
        meets = (np.einsum("ij,ij->i", way, way) < far * far) & (particles.present[near] != 0)
        meets &= np.maximum(particles.body[near, INVERSE_MASS], particles.body[i, INVERSE_MASS]) > 0.0
        near = near[meets]
        found.append(np.column_stack([np.minimum(near, i), np.maximum(near, i)]))
    return np.asarray(np.unique(np.concatenate(found), axis=0))


def rows_with(pairs: Pairs, chunks: Indices, away: Integers) -> Integers:
    """Return the rows of a table in which some particles have a part, in rising order."""
    mine = _rows_in(pairs, home_of(chunks, away), away)
    others = np.concatenate([pairs.first[mine], pairs.second[mine]])
    return _rows_in(pairs, home_of(chunks, others), away)  # a pair that joins two chunks has a row in both


def _rows_in(pairs: Pairs, homes: Integers, away: Integers) -> Integers:
    found = [np.zeros(0, np.int64)]
    for c in np.unique(homes):
        here = slice(pairs.begin[c], pairs.end[c])
        parts = np.isin(pairs.first[here], away) | np.isin(pairs.second[here], away)
        found.append(int(pairs.begin[c]) + np.flatnonzero(parts))
    return np.concatenate(found)


def exchange(pairs: Pairs, gone: Integers, fresh: Pairs) -> bool:
    """Take some rows out of a table and put others in, each in its place within its chunk.

    Return whether there was room; where there was not, the table is as before.
    """
    begin, bounds = pairs.begin.astype(np.int64), np.searchsorted(gone, pairs.begin)
    end = pairs.end - np.diff(bounds) + np.diff(fresh.begin)
    if (end > begin[1:]).any():
        return False
    for c in np.flatnonzero((np.diff(bounds) > 0) | (np.diff(fresh.begin) > 0)):
        old, new = slice(begin[c], pairs.end[c]), slice(*fresh.begin[c : c + 2])
        at = np.searchsorted(key(pairs.first[old], pairs.second[old]), key(fresh.first[new], fresh.second[new]))
        order = spliced(pairs.end[c] - begin[c], gone[slice(*bounds[c : c + 2])] - begin[c], at)
        for table, rows in zip(pairs.tables, fresh.tables, strict=True):
            table[begin[c] : end[c]] = np.concatenate([table[old], rows[new]])[order]
            table[end[c] : pairs.end[c]] = 0
    pairs.end[:] = end
    return True


def spliced(count: int, gone: Integers, at: Integers) -> Integers:
    """Return the order of rows where some of ``count`` are gone and others, counted on, come before the rows ``at``.

    >>> spliced(5, np.array([1, 3]), np.array([0, 3, 5])).tolist()
    [5, 0, 2, 6, 4, 7]
    """
    stays = np.ones(count, bool)
    stays[gone] = False
    kept = np.flatnonzero(stays)
    return np.asarray(np.insert(kept, np.searchsorted(kept, at), count + np.arange(len(at))))


def exchanged_at_walls(old: WallPairs, away: Integers, contacts: Integers) -> WallPairs:
    """Return contacts with walls in which some particles have others now."""
    others = ~np.isin(old.particle, away)
    if len(contacts) == 0 and others.all():
        return old
    return wall_rows(np.sort(np.concatenate([known_wall_contacts(old)[others], contacts])), old)


def contacts_at_walls(
    particles: Particles, away: Integers, walls: Walls, near_walls: NearWalls, slack: Floats, far: float
) -> Integers:
    """Return the contacts that some particles can come to have with walls, which may go ``far`` in m from here."""
    return wall_contacts(rows_of(particles, away), away, walls, near_walls, slack, far)
