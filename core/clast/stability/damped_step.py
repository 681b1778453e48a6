"""The stable step of springs with dashpots: where damping enters the limit of an explicit scheme."""

from __future__ import annotations

from collections.abc import Callable
from math import inf, sqrt

ACCURACY = 0.005
MOST = 12
PROBED = tuple(2.0**k for k in range(-8, 5))
"""Damping ratios at which an integrator is asked how much damping costs."""


def stable_step(eigenvalue: Callable[[float], float], damping_factor: Callable[[float], float]) -> float:
    """Return the largest stable step in s of M a + C v + K u = 0; infinite where nothing swings or is dragged.

    At the limit the fastest mode changes sign from step to step. For one oscillator that makes the limit of Clast's
    integrators 2/ω (√(1 + (g ζ/2)²) − g ζ/2), each with a number g of its own; for many degrees of freedom it makes
    it the step at which the largest eigenvalue of M⁻½ (K + C g/Δt) M⁻½ is 4/Δt². The damping ratio of a pair would
    not do: a dashpot that is mild for two spheres alone is strong in the fastest mode of a packing. Where g of an
    integrator depends on the damping ratio, the largest is taken: then the step is safe, and below the limit.

    Parameters
    ----------
    eigenvalue : (per_time) -> float
        Largest eigenvalue of M⁻½ (K + C · per_time) M⁻½ in rad²/s².
    damping_factor : (zeta) -> float
        Of the integrator.
    """
    undamped = eigenvalue(0.0)
    reach, g = damping_factor(0.0), sensitivity(damping_factor)
    if not undamped > 0.0:
        dragged = g * eigenvalue(1.0)
        return 4.0 * reach * reach / dragged if dragged > 0.0 else inf
    x = 0.5 * sqrt(undamped) / reach  # 1/Δt
    points = [(0.0, undamped), (x, eigenvalue(g * x) if g > 0.0 else undamped)]
    for _ in range(MOST):
        (x_a, found_a), (x_b, found_b) = points[-2:]
        if abs(0.5 * sqrt(found_b) / reach - x_b) <= ACCURACY * x_b:
            break
        slope = (found_b - found_a) / (x_b - x_a)
        base = found_b - slope * x_b
        # (2 reach x)² = base + slope x: exact where dashpots and springs share their modes
        x = (slope + sqrt(max(slope * slope + 16.0 * reach * reach * base, 0.0))) / (8.0 * reach * reach)
        points.append((x, eigenvalue(g * x)))
    x_b, found_b = points[-1]
    return 1.0 / max(x_b, 0.5 * sqrt(found_b) / reach)


def sensitivity(damping_factor: Callable[[float], float]) -> float:
    """Return g of an integrator: 0 where damping costs nothing, 2 with lagging velocities, 4 with predicted ones.

    >>> round(sensitivity(lambda zeta: sqrt(1.0 + zeta**2) - zeta), 12)
    2.0
    """
    undamped = damping_factor(0.0)

    def at(zeta: float) -> float:
        share = damping_factor(zeta)
        return (undamped**2 - share * share) / (zeta * share)

    usual, largest = at(1.0), max(map(at, PROBED))
    return largest if largest > usual * (1.0 + 1e-6) else usual  # rounding must not choose
