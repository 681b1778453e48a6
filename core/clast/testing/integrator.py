"""What holds for every integrator: whole kicks and drifts, the order and the stable step that it tells."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.parts.integrator import Integrator, amplification
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import numbers

Matrix = NDArray[np.float64]
COARSE, FINE = 40, 80


def claims(scheme: Integrator, params: Any) -> list[Claim]:
    """Return what an integrator must keep to."""
    return [
        claim("kicks and drifts of a step each add up to one", lambda: _whole(scheme)),
        claim("an oscillator follows the exact one with the order told", lambda: _order(scheme)),
        claim("without damping, an oscillator neither grows nor fades", lambda share: _keeps(scheme, share), SHARES),
        claim(
            "a damped oscillator is stable at every step below the limit told",
            lambda zeta, share: _stable(scheme, zeta, share),
            numbers(0.0, 3.0),
            SHARES,
        ),
        claim("and not beyond it", lambda zeta: _unstable(scheme, zeta), numbers(0.0, 3.0)),
    ]


SHARES = numbers(0.01, 0.999)


def _step(scheme: Integrator, h: float, zeta: float) -> Matrix:
    return np.asarray(amplification(scheme.stages, np.array([h]), zeta)[0])


def growth(scheme: Integrator, h: float, zeta: float) -> float:
    """Return the factor by which a step of length h lets an oscillator grow at most."""
    return float(np.abs(np.linalg.eigvals(_step(scheme, h, zeta))).max())


def _whole(scheme: Integrator) -> None:
    kicks = math.fsum(stage.kick_before + stage.kick_after for stage in scheme.stages)
    drifts = math.fsum(stage.drift_before + stage.drift_after for stage in scheme.stages)
    must(abs(kicks - 1.0) < 1e-12, f"kicks add up to {kicks!r}")
    must(abs(drifts - 1.0) < 1e-12, f"drifts add up to {drifts!r}")


def _error(scheme: Integrator, steps: int) -> float:
    """Return how far off the position is after a unit of time; velocities start when they belong to."""
    h = 1.0 / steps
    lag = scheme.velocity_lag * h
    state = np.array([1.0, -math.sin(lag), -1.0])
    step = _step(scheme, h, 0.0)
    for _ in range(steps):
        state = step @ state
    return abs(float(state[0]) - math.cos(1.0))


def _order(scheme: Integrator) -> None:
    found = math.log2(_error(scheme, COARSE) / _error(scheme, FINE))
    must(found > scheme.order - 0.2, f"the order is {found:.2f}, {scheme.order} is told")


def _limit(scheme: Integrator, zeta: float) -> float:
    return 2.0 * scheme.damping_factor(zeta)


def _keeps(scheme: Integrator, share: float) -> None:
    h = share * _limit(scheme, 0.0)
    found = growth(scheme, h, 0.0)
    must(abs(found - 1.0) < 1e-9, f"with a step of {h:g}/ω it changes by the factor {found:.9g} a step")


def _stable(scheme: Integrator, zeta: float, share: float) -> None:
    h = share * _limit(scheme, zeta)
    found = growth(scheme, h, zeta)
    must(found <= 1.0 + 1e-9, f"damping ratio {zeta:g}, step {h:g}/ω: it grows by the factor {found:.9g} a step")


def _unstable(scheme: Integrator, zeta: float) -> None:
    h = 1.01 * _limit(scheme, zeta)
    must(growth(scheme, h, zeta) > 1.0, f"damping ratio {zeta:g}: stable at {h:g}/ω too; 'damping_factor' wastes time")
