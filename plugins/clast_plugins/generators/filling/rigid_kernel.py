"""The compiled loops of rigid grains: who is near whom, and what pushes whom, in a fixed order."""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from clast.engine.compiler import compiled, inlined
from clast.maths import vec3
from clast.maths.vec3 import Vec

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

cross, dot, scale, sub = inlined(vec3.cross), inlined(vec3.dot), inlined(vec3.scale), inlined(vec3.sub)


@inlined
def vector(table: Floats, k: int) -> Vec:
    """Return row k of an (n, 3) table."""
    return (table[k, 0], table[k, 1], table[k, 2])


@inlined
def give(table: Floats, k: int, v: Vec) -> None:
    """Add a vector to row k of an (n, 3) table."""
    for c in range(3):
        table[k, c] += v[c]


@compiled
def place_all(centre: Floats, frame: Floats, grain: Ints, arm: Floats, position: Floats) -> None:
    """Write where primaries are.

    Parameters
    ----------
    centre, frame : (g, 3), (g, 3, 3) float64
        Centre of each grain, and its rotation matrix.
    grain, arm : (n,) int64, (n, 3) float64
        Grain of each primary, and where it lies in the grain's own frame.
    position : (n, 3) float64
        Overwritten.
    """
    for k in range(len(grain)):
        g = grain[k]
        for c in range(3):
            position[k, c] = centre[g, c] + dot(vector(frame[g], c), vector(arm, k))


@compiled
def near_primaries(
    centre: Floats,
    reach: Floats,
    couples: Ints,
    begin: Ints,
    position: Floats,
    radius: Floats,
    gap: float,
    pairs: Ints,
) -> int:
    """Write the pairs of primaries of near grains with a gap below ``gap``; return how many there are.

    Parameters
    ----------
    centre, reach : (g, 3), (g,) float64
        A sphere about each grain.
    couples : (c, 2) int64
        Grains whose spheres are near each other.
    begin : (g + 1,) int64
        Where each grain's primaries begin.
    position, radius : (n, 3), (n,) float64
        The primaries.
    pairs : (p, 2) int64
        As many as fit; when the returned number is larger, call again with more room.
    """
    count = 0
    other = np.empty(np.max(begin[1:] - begin[:-1]), np.int64)
    for c in range(len(couples)):
        a, b = couples[c, 0], couples[c, 1]
        inside = 0
        for j in range(begin[b], begin[b + 1]):
            way = sub(vector(position, j), vector(centre, a))
            s = reach[a] + radius[j] + gap
            if dot(way, way) < s * s:
                other[inside] = j
                inside += 1
        for i in range(begin[a], begin[a + 1]):
            way = sub(vector(position, i), vector(centre, b))
            s = reach[b] + radius[i] + gap
            if dot(way, way) >= s * s:
                continue
            for m in range(inside):
                j = other[m]
                way = sub(vector(position, j), vector(position, i))
                s = radius[i] + radius[j] + gap
                if dot(way, way) < s * s:
                    if count < len(pairs):
                        pairs[count, 0] = i
                        pairs[count, 1] = j
                    count += 1
    return count


@compiled
def push_apart(
    position: Floats, radius: Floats, grain: Ints, pairs: Ints, centre: Floats, force: Floats, torque: Floats
) -> float:
    """Add the pushes of overlapping primaries to their grains, 1 per length of overlap; return the largest overlap.

    ``force`` and ``torque`` are (g, 3) float64.
    """
    largest = 0.0
    for p in range(len(pairs)):
        i, j = pairs[p, 0], pairs[p, 1]
        way = sub(vector(position, j), vector(position, i))
        both = radius[i] + radius[j]
        square = dot(way, way)
        if square >= both * both:
            continue
        if square == 0.0:  # which way to push nobody can tell, but it counts
            largest = max(largest, both)
            continue
        distance = sqrt(square)
        overlap = both - distance
        largest = max(largest, overlap)
        f = scale(overlap / distance, way)
        a, b = grain[i], grain[j]
        give(force, a, scale(-1.0, f))
        give(force, b, f)
        give(torque, a, cross(f, sub(vector(position, i), vector(centre, a))))
        give(torque, b, cross(sub(vector(position, j), vector(centre, b)), f))
    return largest


@compiled
def push_inside(
    position: Floats,
    radius: Floats,
    grain: Ints,
    near: Ints,
    room: Floats,
    centre: Floats,
    force: Floats,
    torque: Floats,
) -> float:
    """Add the pushes of bottom, lid and sides on the primaries ``near`` them; return the largest overlap.

    ``room`` (5,) is the radius of the tube or 0, half width and half depth of the box, and bottom and lid in z.
    """
    largest = 0.0
    for p in range(len(near)):
        k = near[p]
        x, y, z = vector(position, k)
        r, g = radius[k], grain[k]
        arm = sub((x, y, z), vector(centre, g))
        below, above = max(room[3] + r - z, 0.0), max(z + r - room[4], 0.0)
        largest = max(largest, max(below, above))
        f = (0.0, 0.0, below - above)
        if room[0] > 0.0:
            out = sqrt(x * x + y * y)
            deep = max(out + r - room[0], 0.0)
            largest = max(largest, deep)
            if deep > 0.0:
                f = (-deep * x / out, -deep * y / out, below - above)
        else:
            left, right = max(r - room[1] - x, 0.0), max(x + r - room[1], 0.0)
            front, back = max(r - room[2] - y, 0.0), max(y + r - room[2], 0.0)
            largest = max(largest, max(max(left, right), max(front, back)))
            f = (left - right, front - back, below - above)
        give(force, g, f)
        give(torque, g, cross(arm, f))
    return largest
