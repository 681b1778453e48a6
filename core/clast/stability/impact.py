"""How long an impact lasts: what a time step must resolve."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, inf, pi, sin, sqrt

POINTS = 32


def impact_duration(energy: Callable[[float], float], mass: float, speed: float, size: float) -> float:
    """Return the duration of an undamped impact in s, 2 ∫ dδ/√(v² − 2 U(δ)/m*) up to the largest overlap.

    Parameters
    ----------
    energy : (overlap) -> float
        Elastic energy U in J.
    mass : float
        Effective mass m* in kg.
    speed : float
        Closing speed v in m/s.
    size : float
        A length in m from which the search for the largest overlap starts.

    Examples
    --------
    A linear spring takes half a period, whatever the speed:

    >>> round(impact_duration(lambda overlap: 0.5 * overlap**2, 1.0, 0.1, 1.0), 6) == round(pi, 6)
    True
    """
    wanted = 0.5 * mass * speed * speed
    deepest = largest_overlap(energy, wanted, size)
    if deepest is None:
        return inf
    total = 0.0
    for k in range(POINTS):  # δ = deepest · sin φ makes the integrand smooth
        angle = (k + 0.5) * 0.5 * pi / POINTS
        left = 1.0 - energy(deepest * sin(angle)) / wanted
        total += cos(angle) / sqrt(left) if left > 0.0 else 0.0
    return 2.0 * deepest / speed * total * 0.5 * pi / POINTS


def largest_overlap(energy: Callable[[float], float], wanted: float, size: float) -> float | None:
    """Return the overlap in m at which the energy is what is wanted; None if it never gets there."""
    low, high = 0.0, 1e-9 * size
    while energy(high) < wanted:
        low, high = high, 2.0 * high
        if high > 1e6 * size:
            return None
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if energy(middle) < wanted else (low, middle)
    return 0.5 * (low + high)
