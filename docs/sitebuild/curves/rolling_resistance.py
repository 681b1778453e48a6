"""Rolling resistances: torque over the angle by which a pressed pair of spheres has rolled, to and fro."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from clast.maths.vec3 import scale
from clast.parts.contact_law import Touch
from clast.parts.params import Params
from clast.parts.rolling_resistance import Pressing, RollingLoad, RollingResistance
from clast.testing.contacts import GLASS, RADIUS, resting
from clast.testing.rolling_resistance import Rolling, turning

Floats = NDArray[np.float64]
LARGEST, FASTEST, CYCLES = 0.3, 100.0, 1.25
"""Largest angle in rad, largest spin in rad/s."""
DT = 5e-7
OVERLAP = 0.02 * 0.5 * RADIUS
PRESSED = Pressing(limit=2e-5, stiffness=3e-5 / OVERLAP, stiffness_before=3e-5 / OVERLAP)
"""As a Hertz contact with that overlap in m."""


def draw(part: RollingResistance, params: Params, figure: Figure) -> str:
    """Draw one cycle and a quarter."""
    axes = figure.subplots()
    angle, torque = rolled(part, params)
    axes.plot(1e3 * angle, torque / (PRESSED.limit * 0.5 * RADIUS))
    axes.axhline(0.0, color="#b9c3ce", linewidth=0.8)
    axes.set(xlabel="rolled angle [mrad]", ylabel="torque / (force x effective radius)")
    return f"Torque against rolling to and fro, with a coefficient of rolling friction of {GLASS.rolling_friction:g}."


def rolled(part: RollingResistance, params: Params) -> tuple[Floats, Floats]:
    """Return angle in rad and torque on j against it in N m; the force between the spheres stays the same."""
    rolling = Rolling(part, part.constants(params, GLASS), part.choices(params))
    history, rows = rolling.fresh, []
    phases = np.arange(0.0, 2.0 * math.pi * CYCLES, DT * FASTEST / LARGEST)
    for phase in phases.tolist():
        spin = (FASTEST * math.cos(phase), 0.0, 0.0)
        touch = resting(OVERLAP)._replace(spin_i=scale(-0.5, spin), spin_j=scale(0.5, spin))
        load, history = answer(rolling, turning(touch, DT), history)
        rows.append(-load.torque_j[0])
    return np.asarray(LARGEST * np.sin(phases)), np.array(rows)


def answer(rolling: Rolling, touch: Touch, history: Any) -> tuple[RollingLoad, Any]:
    """Return the torques of a contact with this force, and what it remembers."""
    load, after = rolling.part.load(touch, rolling.constants, history, PRESSED, DT, rolling.choices)
    return load, after
