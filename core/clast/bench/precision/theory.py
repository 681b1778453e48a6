"""Orders of convergence: fitted to errors, and what theory says of a scheme."""

from __future__ import annotations

from collections.abc import Sequence
from math import exp, log2, sin, sqrt

import numpy as np

from clast.parts.integrator import Stage

FITTED_POINTS = 4
LEAST_POINTS = 3
LARGEST_FITTED = 0.1
ABOVE_FLOOR = 5.0


def fitted_order(steps: Sequence[int], errors: Sequence[float], floor: float = 0.0) -> float | None:
    """Return p of errors ∝ steps^-p, from the finest steps whose errors the reference can tell.

    Errors above a tenth are not asymptotic, those below five times the reference's own error are not known; at most
    four points count. None where fewer than three are left.

    >>> round(fitted_order([10, 20, 40, 80], [0.5, 0.04, 0.01, 0.0025]), 6)
    2.0
    """
    known = [(n, e) for n, e in zip(steps, errors, strict=True) if ABOVE_FLOOR * floor < e < LARGEST_FITTED]
    if len(known) < LEAST_POINTS:
        return None
    n, e = np.array(known[-FITTED_POINTS:]).T
    return -float(np.polyfit(np.log(n), np.log(e), 1)[0])


def oscillator_order(stages: Sequence[Stage], damping_ratio: float) -> float:
    """Return the order of a scheme on an oscillator with damping ratio ζ < 1, found by integrating one.

    x'' = −x − 2 ζ x', x(0) = 0, x'(0) = 1, to t = 2: error of x with 400 steps against that with 800.

    >>> velocity_verlet = [Stage(0.5, 1.0, 0.0, 0.5, 0.0)]
    >>> oscillator_order(velocity_verlet, 0.0), oscillator_order(velocity_verlet, 0.2)
    (2.0, 1.0)
    """
    frequency = sqrt(1.0 - damping_ratio**2)
    exact = exp(-2.0 * damping_ratio) * sin(2.0 * frequency) / frequency
    coarse, fine = (abs(_swing(stages, damping_ratio, 2.0 / n, n) - exact) for n in (400, 800))
    return float(round(log2(coarse / fine)))


def _swing(stages: Sequence[Stage], zeta: float, dt: float, steps: int) -> float:
    x, v, a = 0.0, 1.0, -2.0 * zeta
    for _ in range(steps):
        for stage in stages:
            v += stage.kick_before * a * dt
            x += stage.drift_before * v * dt
            a = -x - 2.0 * zeta * (v + stage.predict * a * dt)
            v += stage.kick_after * a * dt
            x += stage.drift_after * v * dt
    return x
