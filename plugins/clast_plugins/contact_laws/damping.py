"""Damping that gives a coefficient of restitution: one number for every law whose dashpot keeps its ratio."""

from __future__ import annotations

from math import log, pi, sqrt


def damping_ratio(restitution: float) -> float:
    """Return β = −ln e/√(π² + ln² e) for a coefficient of restitution; the limit 1 at 0.

    It is the damping ratio with which a linear spring and dashpot rebound with e, and with √(5/6) before it that of
    Hertz's spring and Tsuji's dashpot.

    >>> damping_ratio(1.0), damping_ratio(0.0)
    (0.0, 1.0)
    """
    if restitution == 0.0:
        return 1.0
    ln_e = log(restitution)
    return abs(ln_e) / sqrt(pi * pi + ln_e * ln_e)
