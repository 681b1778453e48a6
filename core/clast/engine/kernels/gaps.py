"""How near bodies are: directions and overlaps of everything on the neighbour lists, computed when asked."""

from __future__ import annotations

from math import inf, sqrt

from clast.engine.compiler import compiled, inlined
from clast.engine.state import Floats, Pairs, Particles, World
from clast.maths.vec3 import Vec, dot

from .contact_sweep import joined
from .images import way_between
from .layout import FIRST, RADIUS
from .slots import BONDED_PAIRS_TOUCH, CONTACTS, WALLS
from .wall_places import place_on_wall


@compiled
def gaps(world: World, between: Floats, at_walls: Floats) -> None:
    """Write where near bodies are and how far they overlap.

    Parameters
    ----------
    world : World
    between : (p, 4) float64
        For each pair the unit vector from i to j and the overlap in m, below 0 for a gap; the overlap is −∞ where the
        pair does not count: in rows that another chunk has too, and where a bond holds in the contact's stead.
    at_walls : (q, 4) float64
        For each particle near a wall the unit vector to the wall, and the overlap in m; −∞ in rows without a contact,
        at walls that can be touched in several places.
    """
    if CONTACTS:
        for k in range(len(world.pairs.first)):
            counts = world.pairs.sides[k] & FIRST != 0
            if not BONDED_PAIRS_TOUCH:
                counts = counts and not joined(world.pairs, world.bonds, k)
            write_pair(world.particles, world.pairs, k, counts, between)
    if WALLS:
        for p in range(len(world.wall_pairs.wall)):
            k = world.wall_pairs.particle[p]
            near = place_on_wall(world.particles, world.walls, world.wall_pairs, p, world.particles.pose[k, RADIUS])
            write(at_walls, p, near.normal, world.particles.pose[k, RADIUS] - near.distance)


@inlined
def write_pair(particles: Particles, pairs: Pairs, k: int, counts: bool, found: Floats) -> None:
    """Write direction and overlap of pair k."""
    pose, i, j = particles.pose, pairs.first[k], pairs.second[k]
    d = way_between(particles, i, j)
    distance = sqrt(dot(d, d))
    per_distance = 1.0 / distance if distance > 0.0 else 1.0
    overlap = pose[i, RADIUS] + pose[j, RADIUS] - distance - pairs.rest[k] if counts else -inf
    write(found, k, (per_distance * d[0], per_distance * d[1], per_distance * d[2]), overlap)


@inlined
def write(found: Floats, k: int, normal: Vec, overlap: float) -> None:
    """Write one row."""
    for c in range(3):
        found[k, c] = normal[c]
    found[k, 3] = overlap
