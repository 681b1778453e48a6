"""Bond models: stress over strain, pulled, let go and pulled until the bond breaks; and the same sheared."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from clast.engine.records import build, numbers, width
from clast.maths.vec3 import ZERO, norm
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, RandomKey, Strain
from clast.parts.params import Params

Floats = NDArray[np.float64]
L0, R = 0.26e-3, 0.125e-3
GEOMETRY = BondGeometry(L0, R, math.pi * R**2, math.pi * R**4 / 4.0)
KEY = RandomKey(1, 17)
LARGEST, FARTHER, POINTS, RELEASE = 0.1, 3.0, 400, 0.6


class Response(NamedTuple):
    """Strains and stresses in Pa along a path, and whether the bond broke at its end."""

    strain: Floats
    stress: Floats
    broken: bool


def stretched(strain: float) -> Strain:
    """Return the measures of an axial strain."""
    return Strain(strain * L0, ZERO, 0.0, ZERO)


def sheared(strain: float) -> Strain:
    """Return the measures of a shear strain."""
    return Strain(0.0, (0.0, strain * L0, 0.0), 0.0, ZERO)


def draw(model: BondModel, params: Params, figure: Figure) -> str:
    """Draw both curves."""
    left, right = figure.subplots(1, 2)
    pulled = loading_cycle(model, params, stretched, LARGEST)
    slid = loading_cycle(model, params, sheared, FARTHER * float(pulled.strain.max()))
    _curve(left, pulled, "axial strain [%]", "normal stress [MPa]")
    _curve(right, slid, "shear strain [%]", "shear stress [MPa]")
    return "A bond pulled, let go and pulled again (left), and the same across the bond (right); a cross: it breaks."


def _curve(axes: Axes, told: Response, strain: str, stress: str) -> None:
    axes.plot(100.0 * told.strain, 1e-6 * told.stress)
    if told.broken:
        axes.plot(100.0 * told.strain[-1], 1e-6 * told.stress[-1], "x", color="black")
    axes.set(xlabel=strain, ylabel=stress)
    axes.axhline(0.0, color="grey", linewidth=0.5)


def loading_cycle(model: BondModel, params: Params, measures: Callable[[float], Strain], largest: float) -> Response:
    """Load a bond to a share of the strain at which it breaks, let go, load it until it breaks or to ``largest``."""
    straight = follow(model, params, measures, np.geomspace(1e-3 * largest, largest, 2000))
    end = straight.strain[-1]
    turn = RELEASE * end
    legs = [(0.0, turn), (turn, 0.0), (0.0, 1.02 * end)]
    return follow(model, params, measures, np.concatenate([np.linspace(*leg, POINTS) for leg in legs]))


def follow(model: BondModel, params: Params, measures: Callable[[float], Strain], path: Floats) -> Response:
    """Return the response along a path of strains up to where the bond breaks."""
    constants = build(model.Constants, numbers(model.constants(params, GEOMETRY)))
    state = None if model.State is None else build(model.State, [0.0] * width(model.State))
    stresses: list[float] = []
    for strain in path:
        state, load, index = answer(model, constants, state, measures(float(strain)))
        stresses.append((load.normal + math.copysign(norm(load.shear), load.shear[1])) / float(GEOMETRY.A))
        if index >= 1.0:
            return Response(path[: len(stresses)], np.array(stresses), True)
    return Response(path, np.array(stresses), False)


def answer(model: BondModel, constants: Any, state: Any, strain: Strain) -> tuple[Any, BondLoad, float]:
    """Return state, load and failure index at a strain, asked in the order of the step loop: flow, events, load."""
    if model.flow is not None:
        state = model.flow(strain, constants, state)
    load = model.load(strain, constants, state)
    if model.overload is not None and model.on_event is not None:
        while model.failure(strain, load, constants, state) < 1.0 and model.overload(strain, constants, state) > 1.0:
            state = model.on_event(strain, constants, state, KEY)
            load = model.load(strain, constants, state)
    return state, load, model.failure(strain, load, constants, state)
