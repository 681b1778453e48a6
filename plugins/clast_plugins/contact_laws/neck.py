"""The neck between two spheres that stick: its radius, force and energy; Johnson, Kendall and Roberts (1971).

With g = (2 π w/E*)^(1/3) the neck at overlap 0 has the radius a_0 = g R*^(2/3), and all follows from x = √(a/a_0):

    δ = D (x⁴ − x),  F = 2 π w R* (4/3 x⁶ − 2 x³),  U = 2 π w a_0² (8/15 x¹⁰ − 4/3 x⁷ + ½ x⁴ + 3/10),  D = g² R*^(1/3)

U is the integral of F from touch, and x falls no further than to 4^(−1/3), where δ is the smallest.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import Protocol

NARROWEST = 4.0 ** (-1.0 / 3.0)
"""√(a/a_0) of the neck that is about to snap."""
SPAN = 0.75 * NARROWEST
"""How far beyond touch a neck holds, over D."""
CURVE, BEND = 6.0 * NARROWEST * NARROWEST, 4.0 * NARROWEST
THINNEST = 1e-30
"""Least distance from snapping over D: the derivative vanishes there."""


class Sticky(Protocol):
    """Numbers of one pair of materials whose surfaces stick."""

    @property
    def w(self) -> float:
        """Work of adhesion in J/m²."""

    @property
    def g(self) -> float:
        """(2 π w/E*)^(1/3) in m^(1/3)."""


def cube_root(x: float) -> float:
    """Return x^(1/3) of a positive number, with the same bits in compiled code: by square roots and divisions alone.

    x^(1/4 + 1/16 + 1/64) is near; each of Halley's steps leaves two thirds of the cube of the relative error.

    >>> cube_root(27.0)
    3.0
    """
    fourth = sqrt(sqrt(x))
    sixteenth = sqrt(sqrt(fourth))
    near = fourth * sixteenth * sqrt(sqrt(sixteenth))
    return nearer(nearer(nearer(near, x), x), x)


def nearer(y: float, x: float) -> float:
    """Return a better cube root of x: one step of Halley."""
    cube = y * y * y
    return y * (cube + 2.0 * x) / (2.0 * cube + x)


def scaled_root(overlap: float, depth: float) -> float:
    """Return x = √(a/a_0), the larger root of x⁴ − x = δ/D; beyond the end of the neck what it is there.

    From the end, t = x − 4^(−1/3) solves t² (6·4^(−2/3) + 4·4^(−1/3) t + t²) = η. The start takes the cubic term too
    large, so that a quadratic equation in t is left for √η; it is 13 % off at the most, and four of Newton's steps do.
    """
    beyond = max(overlap / depth + SPAN, THINNEST)
    t = 0.5 * (sqrt(CURVE + 4.0 * sqrt(beyond)) - sqrt(CURVE))
    return NARROWEST + refined(refined(refined(refined(t, beyond), beyond), beyond), beyond)


def refined(t: float, beyond: float) -> float:
    """Return one step of Newton towards t² (6·4^(−2/3) + 4·4^(−1/3) t + t²) = η."""
    value = t * t * (CURVE + t * (BEND + t)) - beyond
    return t - value / (t * (2.0 * CURVE + t * (3.0 * BEND + 4.0 * t)))


def neck_depth(radius: float, c: Sticky) -> float:
    """Return D in m, for an effective radius."""
    return c.g * c.g * cube_root(radius)


def touch_radius(radius: float, c: Sticky) -> float:
    """Return a_0 in m, the radius of the neck at overlap 0."""
    root = cube_root(radius)
    return c.g * root * root


def contact_radius(radius: float, overlap: float, c: Sticky) -> float:
    """Return the radius of the neck, a in m."""
    x = scaled_root(overlap, neck_depth(radius, c))
    return touch_radius(radius, c) * x * x


def neck_force(radius: float, overlap: float, c: Sticky) -> float:
    """Return the repulsion 4 E* a³/(3 R*) − √(8 π w E* a³) in N."""
    x = scaled_root(overlap, neck_depth(radius, c))
    cube = x * x * x
    return 2.0 * pi * c.w * radius * cube * (4.0 / 3.0 * cube - 2.0)


def neck_energy(radius: float, overlap: float, c: Sticky) -> float:
    """Return the work of pressing from touch in J: of the elastic bodies, less that of adhesion."""
    x, a_0 = scaled_root(overlap, neck_depth(radius, c)), touch_radius(radius, c)
    cube = x * x * x
    return 2.0 * pi * c.w * a_0 * a_0 * (0.3 + x * cube * (0.5 + cube * (8.0 / 15.0 * cube - 4.0 / 3.0)))


def pull_off_force(radius: float, c: Sticky) -> float:
    """Return the largest pull 3/2 π w R* in N."""
    return 1.5 * pi * c.w * radius


def neck_reach(c: Sticky, radius: float) -> float:
    """Return how far beyond touch the neck holds, 3/4^(4/3) D in m."""
    return SPAN * neck_depth(radius, c)
