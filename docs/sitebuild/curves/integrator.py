"""Integrators: error of an oscillator over the step, without and with damping."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from clast.parts.integrator import Integrator
from clast.parts.params import Params

DURATION = 10.0
STEPS = (10, 20, 50, 100, 200, 500, 1000)


def draw(scheme: Integrator, params: Params, figure: Figure) -> str:
    """Draw the error over ω Δt."""
    axes = figure.subplots()
    for zeta, style in ((0.0, "o-"), (0.1, "s--")):
        told = [error(scheme, count, zeta) for count in STEPS]
        axes.loglog([DURATION / count for count in STEPS], told, style, label=f"damping ratio {zeta:g}")
    axes.set(xlabel="ω Δt", ylabel="error of the position / amplitude")
    axes.legend()
    return (
        f"Error of an oscillator after {DURATION:g} radians, started at its amplitude with the velocity of the instant "
        "that the scheme keeps velocities at, over the step."
    )


def error(scheme: Integrator, count: int, zeta: float) -> float:
    """Return the error of x'' = −x − 2ζ x' from (1, 0), after ``DURATION`` in so many steps."""
    h = DURATION / count
    x, (_, v) = 1.0, exact(scheme.velocity_lag * h, zeta)
    acceleration = -1.0
    for _ in range(count):
        for stage in scheme.stages:
            v += stage.kick_before * h * acceleration
            x += stage.drift_before * h * v
            acceleration = -x - 2.0 * zeta * (v + stage.predict * h * acceleration)
            v += stage.kick_after * h * acceleration
            x += stage.drift_after * h * v
    return float(abs(x - exact(DURATION, zeta)[0]))


def exact(time: float, zeta: float) -> NDArray[np.float64]:
    """Return position and velocity of the oscillator at a time."""
    omega = np.sqrt(1.0 - zeta**2)
    shrunk = np.exp(-zeta * time)
    x = shrunk * (np.cos(omega * time) + zeta / omega * np.sin(omega * time))
    return np.array([x, -shrunk / omega * np.sin(omega * time)])
