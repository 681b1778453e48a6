"""Bond models: stress over strain, pulled, let go and pulled until the bond breaks; and the same sheared."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from clast.maths.vec3 import norm
from clast.parts.bond_model import BondLoad, BondModel, Strain
from clast.parts.params import Params
from clast.testing.bonds import GEOMETRY, Bond, bond, follow, stretched

Floats = NDArray[np.float64]
LARGEST, FARTHER, POINTS, RELEASE = 0.1, 3.0, 400, 0.6


class Response(NamedTuple):
    """Strains and stresses in Pa along a path, and whether the bond broke at its end."""

    strain: Floats
    stress: Floats
    broken: bool


def sheared(gamma: float) -> Strain:
    """Return the measures of a shear strain."""
    return stretched(0.0, gamma)


def draw(model: BondModel, params: Params, figure: Figure) -> str:
    """Draw both curves."""
    left, right = figure.subplots(1, 2)
    pulled = loading_cycle(bond(model, params), stretched, LARGEST)
    slid = loading_cycle(bond(model, params), sheared, FARTHER * float(pulled.strain.max()))
    _curve(left, pulled, "axial strain [%]", "normal stress [MPa]")
    _curve(right, slid, "shear strain [%]", "shear stress [MPa]")
    slowly = "" if model.dashpots is None else " So slowly that its dashpots add nothing."
    return (
        f"A bond pulled, let go, pulled again (left), and the same across the bond (right); a cross: it breaks.{slowly}"
    )


def _curve(axes: Axes, told: Response, strain: str, stress: str) -> None:
    axes.plot(100.0 * told.strain, 1e-6 * told.stress)
    if told.broken:
        axes.plot(100.0 * told.strain[-1], 1e-6 * told.stress[-1], "x", color="black")
    axes.set(xlabel=strain, ylabel=stress)
    axes.axhline(0.0, color="grey", linewidth=0.5)


def loading_cycle(one: Bond, measures: Callable[[float], Strain], largest: float) -> Response:
    """Load a bond to a share of the strain at which it breaks, let go, load it until it breaks or to ``largest``."""
    end = float(respond(one, measures, np.geomspace(1e-3 * largest, largest, 2000)).strain[-1])
    turn = RELEASE * end
    legs = [(0.0, turn), (turn, 0.0), (0.0, 1.02 * end)]
    return respond(one, measures, np.concatenate([np.linspace(*leg, POINTS) for leg in legs]))


def respond(one: Bond, measures: Callable[[float], Strain], path: Floats) -> Response:
    """Return the response along a path of strains up to where the bond breaks."""
    told = follow(one, (measures(float(strain)) for strain in path))
    stress = np.array([_force(each.load) for each in told]) / float(GEOMETRY.A)
    return Response(path[: len(told)], stress, told[-1].failure >= 1.0)


def _force(load: BondLoad) -> float:
    """Return the normal force, or the shear force with its sign: one of them is 0."""
    return load.normal + math.copysign(norm(load.shear), load.shear[1])
