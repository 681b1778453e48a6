"""A torque of constant size against the rolling."""

from __future__ import annotations

from typing import Annotated, Literal, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.maths.vec3 import Vec, across, add, dot, norm, scale, sub
from clast.parts.contact_law import MaterialPair, Touch
from clast.parts.params import Params
from clast.parts.rolling_resistance import Pressing, RollingLoad, RollingLosses, RollingResistance
from clast.plugins.registry import Registry

BRAKING_STEPS = 20.0
"""Steps in which rolling friction may stop a rolling at the soonest: more than the twelve contacts that a particle
among equal ones has, which all brake it at once."""


class ConstantTorque(Params):
    r"""A torque in proportion to the normal force, against the rolling.

    Equation
    --------
    M_r = min(μ_r F_lim R*, I* |ω_r|/(20 Δt)) against ω_r

    Symbols
    -------
    ω_r : part of ω_j − ω_i across the normal, in rad/s
    μ_r : coefficient of rolling friction of the pair
    F_lim : the normal force that limits friction, from the contact law, in N
    R*, I* : effective radius; 1/I* = 1/I_i + 1/I_j

    Options
    -------
    ``spin: own`` acts against each particle's own spin with its own radius, as the paper's authors' program does: for
    comparison only, since it is neither objective nor quiet at rest.

    Limits
    ------
    It cannot hold a sphere on a slope: what rests creeps, slower the smaller the step. The second term of M_r stops a
    rolling in twenty steps at the soonest.

    Source
    ------
    Ai, Chen, Rotter and Ooi (2011), model A, doi:10.1016/j.powtec.2010.09.030.
    """

    spin: Annotated[Literal["relative", "own"], Field(description="the spin that rolling friction acts against")] = (
        "relative"
    )


class Constants(NamedTuple):
    """Coefficient of rolling friction of one pair of materials."""

    mu: float


class Choices(NamedTuple):
    """What must be compiled."""

    own_spin: bool


def constants(params: ConstantTorque, pair: MaterialPair) -> Constants:
    """Return the coefficient of a pair of materials."""
    return Constants(pair.rolling_friction)


def choices(params: ConstantTorque) -> Choices:
    """Return what must be compiled."""
    return Choices(params.spin == "own")


def load(
    touch: Touch, c: Constants, history: None, pressing: Pressing, dt: float, chosen: Choices
) -> tuple[RollingLoad, None]:
    """Return the rolling torques on both bodies."""
    if chosen.own_spin:
        own_i = against(touch.spin_i, c.mu * pressing.limit * touch.radius_i)
        return RollingLoad(own_i, against(touch.spin_j, c.mu * pressing.limit * touch.radius_j)), history
    relative = across(sub(touch.spin_j, touch.spin_i), touch.normal)
    rate = norm(relative)
    # never so much that all contacts of a particle together, or the lag of the spins they see, could turn it round
    stopping = 1.0 / (BRAKING_STEPS * touch.inverse_inertia * dt)
    drag = min(c.mu * pressing.limit * touch.radius / rate, stopping) if rate > 0.0 else 0.0
    torque = scale(drag, relative)
    return RollingLoad(torque, scale(-1.0, torque)), history


def against(spin: Vec, size: float) -> Vec:
    """Return a torque of a given size against a spin."""
    rate = norm(spin)
    return scale(-size / rate if rate > 0.0 else 0.0, spin)


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
    """Return the heat of rolling: the mean of the torques then and now times the turn."""
    if chosen.own_spin:
        heat = -dt * (dot(load.torque_i, touch.spin_i) + dot(load.torque_j, touch.spin_j))
    else:
        heat = 0.5 * dot(add(load.torque_i, drag), touch.turned)
    return RollingLosses(heat, 0.0, load.torque_i)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the constant torque."""
    registry.rolling_resistance(
        "constant_torque",
        RollingResistance(
            summary="a torque of constant size against the rolling",
            Params=ConstantTorque,
            Constants=Constants,
            constants=constants,
            choices=choices,
            load=load,
            losses=losses,
        ),
    )
