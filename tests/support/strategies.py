"""Random vectors, directions and rotations, and the few operations on them that tests need."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import strategies as st

from clast.maths.rotation import Quat, multiply
from clast.maths.vec3 import Vec, add, cross, scale


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_subnormal=False)


def vectors(size: float = 1.0) -> st.SearchStrategy[Vec]:
    """Draw vectors whose components are 0 or not many orders of magnitude below ``size``."""
    return st.tuples(*[numbers(-size, size)] * 3).map(lambda a: tuple(0.0 if abs(x) < 1e-9 * size else x for x in a))


def unit(a: Vec) -> Vec:
    length = math.hypot(*a)
    return (a[0] / length, a[1] / length, a[2] / length)


def directions() -> st.SearchStrategy[Vec]:
    return vectors().filter(lambda a: math.hypot(*a) > 0.1).map(unit)


def rotation(axis: Vec, angle: float) -> Quat:
    s = math.sin(0.5 * angle)
    return (math.cos(0.5 * angle), s * axis[0], s * axis[1], s * axis[2])


def rotations(most: float = math.pi) -> st.SearchStrategy[Quat]:
    return st.builds(rotation, directions(), numbers(-most, most))


def rotate(q: Quat, a: Vec) -> Vec:
    """Return a vector turned by a unit quaternion."""
    u = (q[1], q[2], q[3])
    t = scale(2.0, cross(u, a))
    return add(add(a, scale(q[0], t)), cross(u, t))


def turned_a_little(q: Quat, component: int, angle: float) -> Quat:
    """Return q after a further turn about a coordinate axis in space."""
    axis = [0.0, 0.0, 0.0]
    axis[component] = 1.0
    return multiply(rotation((axis[0], axis[1], axis[2]), angle), q)


def negated(a: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(-x for x in a)


def assert_close(found: object, expected: object, tolerance: float, size: float | None = None) -> None:
    """Compare numbers or vectors, with a tolerance relative to the largest expected number, or to a size."""
    found, expected = np.asarray(found), np.asarray(expected)
    scale = float(np.abs(expected).max()) if size is None else size
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=tolerance * scale)


def assert_turned(found: Vec, before: Vec, q: Quat, size: float, tolerance: float = 1e-12) -> None:
    """Compare a vector with another one turned by q."""
    assert_close(found, rotate(q, before), tolerance, size)
