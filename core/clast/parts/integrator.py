"""Integrator: the order in which a step kicks, drifts and asks for forces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from clast.parts.params import Params


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
        Stable step of an oscillator with damping ratio zeta, as a share of 2/ω.
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
