"""What is drawn as in the contract kit, and the few operations on vectors that tests need beside."""

from __future__ import annotations

import numpy as np

from clast.maths.rotation import Quat, multiply
from clast.maths.vec3 import Vec
from clast.testing.draws import directions, numbers, rotate, rotation, rotations, unit, vectors

__all__ = [
    "assert_close",
    "assert_turned",
    "directions",
    "negated",
    "numbers",
    "rotate",
    "rotation",
    "rotations",
    "turned_a_little",
    "unit",
    "vectors",
]


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
