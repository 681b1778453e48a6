"""Starter: a viscous torque against the rolling, up to a limit."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Time
from clast.maths.vec3 import Vec, across, add, dot, norm, scale, sub
from clast.parts.contact_law import MaterialPair, Touch
from clast.parts.params import Params
from clast.parts.rolling_resistance import Pressing, RollingLoad, RollingLosses, RollingResistance
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """A torque in proportion to the rolling, at most that of friction.

    Equation
    --------
    M = min(μ_r F R* τ |ω_r|, μ_r F R*) against ω_r

    Limits
    ------
    What rests on a slope creeps.

    Source
    ------
    Write here where the law comes from.
    """

    time: Annotated[Time, Field(gt=0, examples=["1 ms"], description="Time τ; slower rolling is resisted less")]


class Constants(NamedTuple):
    """Numbers of one pair of materials: coefficient of rolling friction, and the time in s."""

    mu: float
    tau: float


class Choices(NamedTuple):
    """What the parameters need, known when the loop is compiled."""

    limited: bool


def constants(params: Starter, pair: MaterialPair) -> Constants:
    """Compute the numbers of a pair of materials, once."""
    return Constants(pair.rolling_friction, params.time)


def choices(params: Starter) -> Choices:
    """Return what must be compiled."""
    return Choices(True)


def load(
    touch: Touch, c: Constants, history: None, pressing: Pressing, dt: float, chosen: Choices
) -> tuple[RollingLoad, None]:
    """Return the torques on both bodies, and what the contact remembers."""
    relative = across(sub(touch.spin_j, touch.spin_i), touch.normal)
    rate = norm(relative)
    size = c.mu * pressing.limit * touch.radius * min(c.tau, 1.0 / rate if rate > 0.0 else 0.0)
    torque = scale(size, relative)
    return RollingLoad(torque, scale(-1.0, torque)), history


def losses(
    touch: Touch,
    c: Constants,
    before: None,
    load: RollingLoad,
    after: None,
    pressing: Pressing,
    dt: float,
    chosen: Choices,
    drag: Vec,
) -> RollingLosses:
    """Return the heat since the forces before: the mean of the torques then and now times the turn."""
    return RollingLosses(0.5 * dot(add(load.torque_i, drag), touch.turned), 0.0, load.torque_i)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the part."""
    registry.rolling_resistance(
        "starter",
        RollingResistance(
            summary="viscous torque against the rolling, up to a limit",
            Params=Starter,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            losses=losses,
        ),
    )
