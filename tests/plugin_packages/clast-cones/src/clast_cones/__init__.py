"""A contact law of conical asperities, with friction that remembers."""

from __future__ import annotations

from math import log, pi, sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number, Stress
from clast.maths.vec3 import ZERO, Vec, across, add, dot, norm, scale, sub
from clast.parts.contact_law import ContactLaw, ContactLoad, Features, MaterialPair, Touch
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Cones(Params):
    """A cone pressed into a half-space, sliding with dry friction.

    Equation
    --------
    F_n = K δ² + c √(m* 2 K δ) dδ/dt,  K = 2 E/(π tan β),  F_t = r 2 K δ ξ,  |F_t| ≤ μ K δ²

    Symbols
    -------
    δ, ξ : overlap and tangential displacement since touch in m
    β : slope of the cone's side; E, r : modulus and ratio of tangential to normal stiffness
    c : 2 β_e, β_e = −ln e/√(π² + ln² e)

    Limits
    ------
    No rolling friction; the coefficient of restitution is only about e.

    Source
    ------
    Sneddon (1965), doi:10.1016/0020-7225(65)90019-4, for the cone.
    """

    modulus: Annotated[Stress, Field(gt=0, examples=["1 GPa"], description="Reduced modulus E")]
    slope: Annotated[Number, Field(gt=0, examples=[0.2], description="Slope of the cone's side, tan β")]
    tangential_ratio: Annotated[Number, Field(gt=0, le=1, description="Tangential over normal stiffness, r")] = 0.8


class Constants(NamedTuple):
    """Numbers of one pair of materials."""

    K: float
    ratio: float
    damping: float
    mu: float


class Choices(NamedTuple):
    """What the scene needs."""

    damping: bool
    sliding: bool


class History(NamedTuple):
    """Tangential displacement since touch in m."""

    xi: Vec


def constants(params: Cones, pair: MaterialPair) -> Constants:
    """Compute the numbers of a pair of materials."""
    ln_e = log(max(pair.restitution, 1e-6))
    K = 2.0 * params.modulus / (pi * params.slope)
    return Constants(K, params.tangential_ratio, -2.0 * ln_e / sqrt(pi * pi + ln_e * ln_e), pair.sliding_friction)


def choices(params: Cones, features: Features) -> Choices:
    """Return what must be compiled."""
    return Choices(features.damping, features.sliding)


def slid(touch: Touch, c: Constants, xi: Vec) -> Vec:
    """Return the tangential displacement that friction leaves, in m."""
    xi = add(xi, across(touch.moved, touch.normal))
    most = c.mu * touch.overlap / (2.0 * c.ratio)
    size = norm(xi)
    return scale(most / size if size > most else 1.0, xi)


def load(touch: Touch, c: Constants, history: History, dt: float, chosen: Choices) -> tuple[ContactLoad, History]:
    """Return the force on body j, and what is remembered."""
    force = c.K * touch.overlap * touch.overlap
    if chosen.damping:
        force = force - c.damping * sqrt(2.0 * c.K * touch.overlap / touch.inverse_mass) * dot(
            touch.velocity, touch.normal
        )
    F_t, xi = ZERO, history.xi
    if chosen.sliding:
        xi = slid(touch, c, history.xi)
        F_t = scale(2.0 * c.K * c.ratio * touch.overlap, xi)
    return ContactLoad(sub(scale(force, touch.normal), F_t), ZERO, ZERO), History(xi)


def energy(touch: Touch, c: Constants, history: History, chosen: Choices) -> float:
    """Return the elastic energy in J."""
    stored = c.K * touch.overlap * touch.overlap * touch.overlap / 3.0
    if chosen.sliding:
        stored = stored + c.K * c.ratio * touch.overlap * dot(history.xi, history.xi)
    return stored


def stiffness(c: Constants, radius: float, overlap: float) -> float:
    """Return the normal tangent stiffness in N/m."""
    return 2.0 * c.K * overlap


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the law."""
    registry.contact_law(
        "cones",
        ContactLaw(
            summary="conical asperities with dry friction",
            Params=Cones,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            energy=energy,
            stiffness=stiffness,
            History=History,
        ),
    )
