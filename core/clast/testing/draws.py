"""What claims are tried on: random numbers, vectors, directions and rotations that shrink to simple ones."""

from __future__ import annotations

import math

from hypothesis import strategies as st

from clast.maths.rotation import Quat
from clast.maths.vec3 import Vec, add, cross, scale


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    """Draw floats of an interval, 0 or not many orders of magnitude below its ends."""
    least = 1e-9 * max(abs(low), abs(high))
    return st.floats(low, high, allow_subnormal=False).map(lambda x: 0.0 if low <= 0.0 and abs(x) < least else x)


def vectors(size: float = 1.0) -> st.SearchStrategy[Vec]:
    """Draw vectors with components up to ``size``."""
    return st.tuples(*[numbers(-size, size)] * 3)


def unit(a: Vec) -> Vec:
    """Return the direction of a vector."""
    length = math.hypot(*a)
    return (a[0] / length, a[1] / length, a[2] / length)


def directions() -> st.SearchStrategy[Vec]:
    """Draw unit vectors."""
    return vectors().filter(lambda a: math.hypot(*a) > 0.1).map(unit)


def rotation(axis: Vec, angle: float) -> Quat:
    """Return the unit quaternion of a turn about a unit vector."""
    s = math.sin(0.5 * angle)
    return (math.cos(0.5 * angle), s * axis[0], s * axis[1], s * axis[2])


def rotations(most: float = math.pi) -> st.SearchStrategy[Quat]:
    """Draw turns up to an angle in rad."""
    return st.builds(rotation, directions(), numbers(-most, most))


def rotate(q: Quat, a: Vec) -> Vec:
    """Return a vector turned by a unit quaternion."""
    u = (q[1], q[2], q[3])
    t = scale(2.0, cross(u, a))
    return add(add(a, scale(q[0], t)), cross(u, t))


def negated(a: Vec) -> Vec:
    """Return −a."""
    return (-a[0], -a[1], -a[2])
