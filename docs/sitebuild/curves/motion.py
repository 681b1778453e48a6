"""Motions: velocity over time, of a wall that answers to force before a spring."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from clast.config.describe import parameters
from clast.maths.vec3 import ZERO, Vec, add, scale
from clast.parts.motion import Motion, Pressed
from clast.parts.params import Params

Floats = NDArray[np.float64]
SPRING, MASS, ANSWERING = 1e4, 1e-3, 0.05
POINTS = 2000


def draw(motion: Motion, params: Params, figure: Figure) -> str:
    """Draw the three components, where they are not 0."""
    axes = figure.subplots()
    time = np.linspace(0.0, _until(motion, params), POINTS)
    if motion.spin is not None:
        return turned(motion, params, time, axes)
    velocity = told(motion, params, time) if motion.answer is None else answered(motion, params, time)
    for name, one in zip("xyz", velocity.T, strict=True):
        if np.any(one):
            axes.plot(1e3 * time, 1e3 * one, label=name)
    axes.set(xlabel="time [ms]", ylabel="velocity [mm/s]")
    axes.legend()
    if motion.answer is None:
        return "Velocity of the wall."
    return f"Velocity of the wall against a spring of {1e-3 * SPRING:g} kN/m that it touches at the start."


def turned(motion: Motion, params: Params, time: Floats, axes: Any) -> str:
    """Draw the three components of the angular velocity, where they are not 0."""
    assert motion.spin is not None
    course = motion.course(params)
    spins = np.array([motion.spin(course, float(t)) for t in time])
    for name, one in zip("xyz", spins.T, strict=True):
        if np.any(one):
            axes.plot(time, one, label=name)
    axes.set(xlabel="time [s]", ylabel="angular velocity [rad/s]")
    axes.legend()
    return "Angular velocity of the wall about its pivot."


def told(motion: Motion, params: Params, time: Floats) -> Floats:
    """Return the (n, 3) velocities in m/s of a motion that knows them beforehand."""
    assert motion.velocity is not None
    course = motion.course(params)
    return np.array([motion.velocity(course, float(t)) for t in time])


def answered(motion: Motion, params: Params, time: Floats) -> Floats:
    """Return the (n, 3) velocities in m/s of a motion that a spring presses on."""
    assert motion.answer is not None
    course, span = motion.course(params), float(time[1] - time[0])
    where: Vec = ZERO
    velocity: Vec = ZERO
    rows = []
    for t in time:
        pressed = Pressed(force=scale(-SPRING, where), mass=MASS, velocity=velocity, span=span, since=span)
        velocity = motion.answer(course, float(t), pressed)
        where = add(where, scale(span, velocity))
        rows.append(velocity)
    return np.array(rows)


def _until(motion: Motion, params: Params) -> float:
    """Return how long to look in s: twice the longest time or period that the parameters name."""
    if motion.answer is not None:
        return ANSWERING
    units = {each.name: each.kind.split(" or ")[0] for each in parameters(type(params))}
    named = {name: getattr(params, name, None) for name, unit in units.items() if unit in ("s", "Hz", "1/s", "rad/s")}
    given = {name: value for name, value in named.items() if isinstance(value, float) and 0.0 < value < math.inf}
    periods = [value if units[name] == "s" else 1.0 / value for name, value in given.items()]
    return 2.0 * max(periods, default=0.5)
