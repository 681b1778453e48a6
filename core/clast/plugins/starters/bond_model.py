"""Starter: an elastic bond that breaks at a largest elongation."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number, Stress
from clast.maths.vec3 import dot, scale
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, Each, Stiffness, Strain
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Starter(Params):
    """Elastic cylinder that breaks where it is elongated too far.

    Equation
    --------
    F_n = E A/L0 · axial,  F_t = G A/L0 · shear,  M_t = G J/L0 · twist,  M_b = E I/L0 · bending;  breaks when
    axial/L0 ≥ ε_br

    Limits
    ------
    Shear, torsion and bending break nothing.

    Source
    ------
    Name where the law was published.
    """

    young_modulus: Annotated[Stress, Field(gt=0, examples=["500 MPa"], description="Young's modulus E of the bond")]
    poisson_ratio: Annotated[Number, Field(gt=-1, lt=0.5, examples=[0.2], description="Poisson's ratio of the bond")]
    breakage_strain: Annotated[Number, Field(gt=0, examples=[0.01], description="Strain at which it breaks, ε_br")]


class Constants(NamedTuple):
    """Numbers of a bond: stiffness against each strain measure, one over the elongation that breaks it."""

    axial: float
    shear: float
    torsion: float
    bending: float
    per_breakage: float


def springs(params: Starter, bond: BondGeometry) -> tuple[Each, Each, Each, Each]:
    """Return E A/L0, G A/L0, G J/L0 and E I/L0 of all bonds, J = 2 I."""
    E, G = params.young_modulus, params.young_modulus / (2.0 * (1.0 + params.poisson_ratio))
    return E * bond.A / bond.L0, G * bond.A / bond.L0, G * 2.0 * bond.I / bond.L0, E * bond.I / bond.L0


def stiffness(params: Starter, bond: BondGeometry) -> Stiffness:
    """Return the stiffness against each strain measure, for the time step."""
    return Stiffness(*springs(params, bond))


def constants(params: Starter, bond: BondGeometry) -> Constants:
    """Compute the numbers of all bonds, once."""
    return Constants(*springs(params, bond), per_breakage=1.0 / (params.breakage_strain * bond.L0))


def load(strain: Strain, c: Constants, state: None) -> BondLoad:
    """Return what the bond carries: the derivatives of its energy."""
    return BondLoad(
        normal=c.axial * strain.axial,
        shear=scale(c.shear, strain.shear),
        torsion=c.torsion * strain.twist,
        bending=scale(c.bending, strain.bending),
    )


def energy(strain: Strain, c: Constants, state: None) -> float:
    """Return the elastic energy in J."""
    stretched = c.axial * strain.axial * strain.axial + c.shear * dot(strain.shear, strain.shear)
    return 0.5 * (stretched + c.torsion * strain.twist * strain.twist + c.bending * dot(strain.bending, strain.bending))


def failure(strain: Strain, load: BondLoad, c: Constants, state: None) -> float:
    """Return how near the bond is to breaking: 0 undeformed, 1 where it breaks."""
    return max(strain.axial * c.per_breakage, 0.0)


def mode(strain: Strain, load: BondLoad, c: Constants, state: None) -> int:
    """Return which of ``modes`` broke it."""
    return 0


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the model."""
    registry.bond_model(
        "starter",
        BondModel(
            summary="linear elastic, breaks at an elongation",
            Params=Starter,
            Constants=Constants,
            constants=constants,
            stiffness=stiffness,
            load=load,
            energy=energy,
            failure=failure,
            mode=mode,
            modes=("tension",),
        ),
    )
