"""Vectors as plain 3-tuples: laws read like equations, in Python and compiled alike."""

from __future__ import annotations

from math import sqrt

Vec = tuple[float, float, float]

ZERO: Vec = (0.0, 0.0, 0.0)


def add(a: Vec, b: Vec) -> Vec:
    """Return a + b."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vec, b: Vec) -> Vec:
    """Return a − b."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(s: float, a: Vec) -> Vec:
    """Return s a."""
    return (s * a[0], s * a[1], s * a[2])


def dot(a: Vec, b: Vec) -> float:
    """Return a · b.

    >>> dot((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    32.0
    """
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec, b: Vec) -> Vec:
    """Return a x b.

    >>> cross((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    (0.0, 0.0, 1.0)
    """
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a: Vec) -> float:
    """Return |a|.

    >>> norm((3.0, 0.0, 4.0))
    5.0
    """
    return sqrt(dot(a, a))


def along(a: Vec, n: Vec) -> Vec:
    """Return the part of a along the unit vector n."""
    return scale(dot(a, n), n)


def across(a: Vec, n: Vec) -> Vec:
    """Return the part of a perpendicular to the unit vector n.

    >>> across((1.0, 2.0, 3.0), (0.0, 0.0, 1.0))
    (1.0, 2.0, 0.0)
    """
    return sub(a, along(a, n))
