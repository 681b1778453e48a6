"""Approach: when a wall that moves with a known velocity has come a distance."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

EXACT = 1e-12
"""Error of a distance that counts as none, as a share of it."""

LOOKS = 20
"""Looks at a rate that tell whether it stays what it is."""

FIRST, DOUBLINGS = 1e-9, 70
"""Shortest time in s that is integrated over, and how often it is doubled: up to 10¹² s."""


class Arrival(NamedTuple):
    """When the distance is come in s, None where it never is; and the farthest that was come in m."""

    time: float | None
    distance: float


def time_of(rate: Callable[[float], float], distance: float) -> Arrival:
    """Return when the integral of a rate of approach in m/s from the start on reaches a distance in m.

    The rate may change in any way that shows at a twentieth of the time passed.

    Examples
    --------
    >>> time_of(lambda t: 2.0, 3.0)
    Arrival(time=1.5, distance=3.0)
    >>> round(time_of(lambda t: 2.0 * t, 9.0).time, 9)
    3.0
    """
    start = rate(0.0)
    if start > 0.0 and all(rate(distance / start * k / LOOKS) == start for k in range(1, LOOKS + 1)):
        return Arrival(distance / start, distance)
    before, end, come, farthest = 0.0, FIRST, 0.0, 0.0
    for _ in range(DOUBLINGS):
        on = _way(rate, before, end)
        if come + on >= distance:
            return Arrival(_within(rate, before, end, distance - come), distance)
        before, end, come = end, 2.0 * end, come + on
        farthest = max(farthest, come)
    return Arrival(None, farthest)


def _within(rate: Callable[[float], float], begin: float, end: float, distance: float) -> float:
    """Return the time between two others at which a distance is come since the first, in s."""
    from scipy.optimize import brentq

    return float(brentq(lambda t: _way(rate, begin, t) - distance, begin, end, xtol=EXACT * end, rtol=EXACT))


def _way(rate: Callable[[float], float], begin: float, end: float) -> float:
    from scipy.integrate import quad

    # full output keeps it quiet where a rate jumps
    return float(quad(rate, begin, end, epsabs=0.0, epsrel=EXACT, limit=200, full_output=1)[0])
