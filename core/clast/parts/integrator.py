"""Integrator: the order in which a step kicks, drifts and asks for forces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.parts.params import Params

GROWTH = 1e-7
"""Share by which a step may enlarge what swings and still count as stable: rounding, where nothing is damped."""

RATIO = 1.002
"""From one step that is tried to the next."""


class Stage(NamedTuple):
    """One force evaluation and the moves around it; every number is a fraction of the time step.

    The stage reads: v += kick_before a; x += drift_before v; forces at x with the velocity v + predict a;
    v += kick_after a; x += drift_after v. Orientations and spins move alike.
    """

    kick_before: float
    drift_before: float
    predict: float
    kick_after: float
    drift_after: float


@dataclass(frozen=True)
class Integrator:
    """The part a plugin registers with ``registry.integrator(name, Integrator(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``integrator``.
    stages : tuple of Stage
        The scheme: kicks and drifts each add up to 1.
    damping_factor : (zeta) -> float
        Stable step of an oscillator with damping ratio zeta, as a share of 2/ω; :func:`stable_share` finds it for any
        stages.
    order : int
        Order of accuracy where forces are smooth.
    start_kick : (params) -> float
        Kick before the first step, as a fraction of the step; 0 for all but one old habit of leapfrog.
    """

    summary: str
    Params: type[Params]
    stages: tuple[Stage, ...]
    damping_factor: Callable[[float], float]
    order: int
    start_kick: Callable[[Any], float] = lambda params: 0.0

    @property
    def velocity_lag(self) -> float:
        """How much later than positions velocities belong at the end of a step, as a fraction of the step.

        Kicks stand for the whole time around them: their mean instant is half a step after that of the velocity.
        """
        at, mean = 0.0, 0.0
        for stage in self.stages:
            mean += stage.kick_before * at
            at += stage.drift_before
            mean += stage.kick_after * at
            at += stage.drift_after
        return mean - 0.5

    @property
    def after_forces(self) -> float:
        """Time from the last force evaluation of a step to its end, as a fraction of the step."""
        return self.stages[-1].drift_after


def amplification(stages: Sequence[Stage], h: NDArray[np.float64], zeta: float) -> NDArray[np.float64]:
    """Return what a step of length h does to (x, v, a) of x'' = −x − 2ζ x': (n, 3, 3) from (n,)."""
    step = np.broadcast_to(np.eye(3), (len(h), 3, 3)).copy()
    for stage in stages:
        step[:, 1] += (stage.kick_before * h)[:, None] * step[:, 2]
        step[:, 0] += (stage.drift_before * h)[:, None] * step[:, 1]
        seen = step[:, 1] + (stage.predict * h)[:, None] * step[:, 2]
        step[:, 2] = -step[:, 0] - 2.0 * zeta * seen
        step[:, 1] += (stage.kick_after * h)[:, None] * step[:, 2]
        step[:, 0] += (stage.drift_after * h)[:, None] * step[:, 1]
    return step


@cache
def stable_share(stages: tuple[Stage, ...], zeta: float) -> float:
    """Return the stable step of an oscillator with damping ratio ζ as a share of 2/ω, found from the stages.

    Steps are tried from small to large; the limit is the first at which one step enlarges what swings.

    Examples
    --------
    >>> round(stable_share((Stage(0.5, 1.0, 0.0, 0.5, 0.0),), 0.0), 5)
    1.0
    """
    low, high = 1e-3 / (1.0 + zeta), 2.02 * len(stages)  # no scheme allows more than 2/ω for each evaluation of forces
    tried = low * RATIO ** np.arange(np.ceil(np.log(high / low) / np.log(RATIO)) + 1.0)
    first = int(np.argmax(_grows(stages, tried, zeta)))
    low, high = float(tried[max(first - 1, 0)]), float(tried[first])
    while high - low > 1e-13 * high:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if _grows(stages, np.array([middle]), zeta)[0] else (middle, high)
    return 0.5 * low


def _grows(stages: Sequence[Stage], h: NDArray[np.float64], zeta: float) -> NDArray[np.bool_]:
    largest = np.abs(np.linalg.eigvals(amplification(stages, h, zeta))).max(axis=1)
    return np.asarray(largest > 1.0 + GROWTH)
