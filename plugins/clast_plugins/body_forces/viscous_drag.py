"""Drag of a viscous fluid around every particle."""

from __future__ import annotations

from math import pi
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Density, SpinVector, Unit, VelocityVector
from clast.maths.vec3 import ZERO, Vec, norm, scale, sub
from clast.parts.body_force import BodyForce
from clast.parts.params import Params
from clast.plugins.registry import Registry

Floats = NDArray[np.float64]
NEWTON = 0.44
"""Drag coefficient of a sphere in fast flow, 1000 < Re < 2 10⁵."""


class ViscousDrag(Params):
    r"""Drag and torque of a fluid that flows past each particle as if it were alone.

    Equation
    --------
    F = 6 π μ r φ(Re) (u − v),  M = 8 π μ r³ (ω_f − ω)
    φ = 1;  with a ``fluid_density`` φ = max(1 + 0.15 Re^0.687, 0.44 Re/24),  Re = 2 r ρ |u − v|/μ

    Symbols
    -------
    μ, ρ : ``viscosity`` in Pa s and ``fluid_density`` in kg/m³ of the fluid
    u, ω_f : ``fluid_velocity`` in m/s and ``fluid_spin`` in rad/s, half its vorticity: the same everywhere
    r, v, ω : radius, velocity and spin of a particle

    Limits
    ------
    Without a fluid density the drag is Stokes's, for Re below about 0.1; with it, up to 2 10⁵. Particles do not shelter
    each other, and the fluid does not feel them; walls do not slow it. No added mass, no history force, no lift, no
    buoyancy: for that, take (1 − ρ/ρ_particle) g as gravity. Forces are those of the true size: mass scaling leaves
    them what they are. What the drag takes is work of body forces in the ledger. It counts in the stable step.

    Source
    ------
    G. G. Stokes (1851), Transactions of the Cambridge Philosophical Society 9, 8–106; torque: G. Kirchhoff (1876),
    Vorlesungen über mathematische Physik, 26. L. Schiller, A. Naumann (1933), Zeitschrift des Vereines Deutscher
    Ingenieure 77, 318–320; R. Clift, J. R. Grace, M. E. Weber (1978), Bubbles, Drops, and Particles, Table 5.1.
    """

    viscosity: Annotated[float, Unit("Pa s"), Field(gt=0, examples=["1 mPa s"], description="Viscosity of the fluid")]
    fluid_velocity: Annotated[VelocityVector, Field(description="Velocity of the fluid")] = ZERO
    fluid_spin: Annotated[SpinVector, Field(description="Spin of the fluid, half its vorticity")] = ZERO
    fluid_density: Annotated[
        Density | None, Field(gt=0, description="Density of the fluid, for drag beyond Stokes's; none: Stokes's alone")
    ] = None


class Numbers(NamedTuple):
    """Viscosity in Pa s, density in kg/m³ or 0, velocity in m/s and spin in rad/s of the fluid."""

    viscosity: float
    density: float
    velocity: Vec
    spin: Vec


def numbers(params: ViscousDrag, mass_scaling: float) -> Numbers:
    """Return the numbers of the fluid."""
    return Numbers(params.viscosity, params.fluid_density or 0.0, params.fluid_velocity, params.fluid_spin)


def beyond_stokes(reynolds: float) -> float:
    """Return by how much the drag exceeds that of Stokes: φ.

    >>> round(beyond_stokes(1.0), 3), round(beyond_stokes(2400.0), 3)
    (1.15, 44.0)
    """
    intermediate: float = 1.0 + 0.15 * reynolds**0.687
    return max(intermediate, NEWTON / 24.0 * reynolds)


def load(numbers: Numbers, x: Vec, v: Vec, w: Vec, radius: float, time: float) -> tuple[Vec, Vec]:
    """Return the force in N and the torque in N m on a particle.

    >>> water = Numbers(1.0 / (2.0 * pi), 0.0, velocity=(0.0, 0.0, 0.0), spin=(0.0, 0.0, 0.0))
    >>> load(water, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.5, 0.0)
    ((-1.5, 0.0, 0.0), (0.0, 0.0, -0.5))
    """
    slip = sub(numbers.velocity, v)
    drag = 6.0 * pi * numbers.viscosity * radius
    if numbers.density > 0.0:
        drag *= beyond_stokes(2.0 * radius * numbers.density / numbers.viscosity * norm(slip))
    turning = 8.0 * pi * numbers.viscosity * radius * radius * radius
    return scale(drag, slip), scale(turning, sub(numbers.spin, w))


def damping(numbers: Numbers, radius: Floats, velocity: Floats) -> tuple[Floats, Floats]:
    """Return the slopes of the drag along the flow, (n,) in N s/m, and of the torque, (n,) in N m s.

    d(Re φ)/dRe is 1 + 0.253 Re^0.687 or 2 (0.44 Re/24), and the larger of both is never below it.
    """
    slip = np.linalg.norm(velocity - np.array(numbers.velocity), axis=1)
    reynolds = 2.0 * radius * numbers.density / numbers.viscosity * slip
    slope = np.maximum(1.0 + 0.15 * 1.687 * reynolds**0.687, NEWTON / 12.0 * reynolds)
    drag = 6.0 * pi * numbers.viscosity * radius
    return drag * slope, 8.0 * pi * numbers.viscosity * radius**3


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the drag."""
    registry.body_force(
        "viscous_drag",
        BodyForce(
            summary="drag and torque of a viscous fluid, at rest or in uniform flow",
            Params=ViscousDrag,
            Numbers=Numbers,
            numbers=numbers,
            load=load,
            damping=damping,
        ),
    )
