"""Dampings: how a mass on a spring comes to rest."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from clast.parts.damping import Damping
from clast.parts.params import Params
from clast.testing.damping import added

Floats = NDArray[np.float64]
PERIODS, STEPS = 8, 400
"""Periods that are looked at, and steps in each."""
RATE = 2.0 * math.pi
"""Angular frequency of the mass on its spring in rad/s: one period takes a second."""


def draw(part: Damping, params: Params, figure: Figure) -> str:
    """Draw the place of the mass, and where it would be without damping."""
    axes = figure.subplots()
    time, place = let_go(part, params)
    axes.plot(time, np.cos(RATE * time), color="#b9c3ce", linewidth=1.0, label="without damping")
    axes.plot(time, place, label="with it")
    axes.set(xlabel="time / period", ylabel="place / place at the start")
    axes.legend(loc="upper right")
    return "A mass on a spring, let go at rest; its period is one second."


def let_go(part: Damping, params: Params) -> tuple[Floats, Floats]:
    """Return times in s and places over the first one, by leapfrog steps."""
    numbers, dt = part.numbers(params), 1.0 / STEPS
    time = dt * np.arange(PERIODS * STEPS + 1)
    x, v, places = 1.0, 0.0, [1.0]
    for step in range(len(time) - 1):
        pull = -RATE * RATE * x
        (more,) = added(part, numbers, [(pull, 0.0, 0.0)], [(v, 0.0, 0.0)], dt, step)
        v += dt * (pull + more[0])
        x += dt * v
        places.append(x)
    return np.asarray(time, np.float64), np.array(places)
