"""Starter: a linear spring with a dashpot."""

from __future__ import annotations

from math import log, pi, sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Unit
from clast.maths.vec3 import ZERO, dot, scale
from clast.parts.contact_law import ContactLaw, ContactLoad, Features, MaterialPair, Touch
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """Linear spring and dashpot along the normal, without friction.

    Equation
    --------
    F_n = k δ + c dδ/dt,  c = 2 ζ √(k m*),  ζ = −ln e/√(π² + ln² e)

    Limits
    ------
    No friction; stiffness does not depend on size or overlap.

    Source
    ------
    Cundall and Strack (1979), doi:10.1680/geot.1979.29.1.47.
    """

    stiffness: Annotated[float, Unit("N/m"), Field(gt=0, examples=["10 kN/m"], description="Stiffness k")]


class Constants(NamedTuple):
    """Numbers of one pair of materials: stiffness in N/m and damping ratio."""

    k: float
    zeta: float


class Choices(NamedTuple):
    """What the scene needs, known when the loop is compiled."""

    damping: bool


def constants(params: Starter, pair: MaterialPair) -> Constants:
    """Compute the numbers of a pair of materials, once."""
    ln_e = log(max(pair.restitution, 1e-6))
    return Constants(params.stiffness, -ln_e / sqrt(pi * pi + ln_e * ln_e))


def choices(params: Starter, features: Features) -> Choices:
    """Return what must be compiled."""
    return Choices(features.damping)


def load(touch: Touch, c: Constants, history: None, dt: float, chosen: Choices) -> tuple[ContactLoad, None]:
    """Return the force on body j, torques on both, and what the contact remembers."""
    force = c.k * touch.overlap
    if chosen.damping:
        force = force - 2.0 * c.zeta * sqrt(c.k / touch.inverse_mass) * dot(touch.velocity, touch.normal)
    return ContactLoad(scale(force, touch.normal), ZERO, ZERO), history


def energy(touch: Touch, c: Constants, history: None, chosen: Choices) -> float:
    """Return the elastic energy in J."""
    return 0.5 * c.k * touch.overlap * touch.overlap


def stiffness(c: Constants, radius: float, overlap: float) -> float:
    """Return the largest stiffness along the normal in N/m, for the time step."""
    return c.k


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the law."""
    registry.contact_law(
        "starter",
        ContactLaw(
            summary="linear spring and dashpot without friction",
            Params=Starter,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            energy=energy,
            stiffness=stiffness,
        ),
    )
