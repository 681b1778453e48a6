"""Bonds that tire: every overload opens them by a random share, and leaves them weaker."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number, Stress
from clast.maths.counter_random import uniform
from clast.maths.vec3 import dot, scale
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, Each, RandomKey, Stiffness, Strain
from clast.parts.params import Params
from clast.plugins.registry import Registry

CLAST_API = 1


class Tiring(Params):
    """Elastic bond that opens by random shares of its stress, each time at a lower one.

    Equation
    --------
    σ = E (axial/L0 − ε_o).  Where |σ| > σ_c (1 − w): ε_o grows by u σ/E with u from U(0, 1), and w by q (1 − w);
    breaks where axial/L0 ≥ ε_br

    Symbols
    -------
    ε_o, w : opening and weakness, both 0 at the start; σ_c, q : strength and what every overload takes of it

    Limits
    ------
    Shear, torsion and bending stay elastic.

    Source
    ------
    A model for tests.
    """

    young_modulus: Annotated[Stress, Field(gt=0, examples=["500 MPa"], description="Young's modulus E")]
    strength: Annotated[Stress, Field(gt=0, examples=["3 MPa"], description="Stress σ_c of the first overload")]
    weakening: Annotated[Number, Field(ge=0, lt=1, examples=[0.3], description="Share q that an overload takes")]
    breakage_strain: Annotated[Number, Field(gt=0, examples=[0.02], description="Strain ε_br that breaks it")]


class Constants(NamedTuple):
    """Numbers of a bond."""

    E: float
    area: float
    per_L: float
    shear: float
    torsion: float
    bending: float
    strength: float
    weakening: float
    per_breakage: float


class State(NamedTuple):
    """Opening as a strain, share of the strength that is gone, and number of overloads."""

    opening: float
    weakness: float
    overloads: float


def springs(params: Tiring, bond: BondGeometry) -> tuple[Each, Each, Each, Each]:
    """Return the stiffness against each strain measure; Poisson's ratio is 0.2."""
    E, G = params.young_modulus, params.young_modulus / 2.4
    return E * bond.A / bond.L0, G * bond.A / bond.L0, 2.0 * G * bond.I / bond.L0, E * bond.I / bond.L0


def stiffness(params: Tiring, bond: BondGeometry) -> Stiffness:
    """Return it as a record."""
    return Stiffness(*springs(params, bond))


def constants(params: Tiring, bond: BondGeometry) -> Constants:
    """Compute the numbers of all bonds."""
    _, shear, torsion, bending = springs(params, bond)
    law = (params.strength, params.weakening, 1.0 / params.breakage_strain)
    return Constants(params.young_modulus, bond.A, 1.0 / bond.L0, shear, torsion, bending, *law)


def stress(strain: Strain, c: Constants, state: State) -> float:
    """Return σ in Pa."""
    return c.E * (strain.axial * c.per_L - state.opening)


def load(strain: Strain, c: Constants, state: State) -> BondLoad:
    """Return what the bond carries."""
    return BondLoad(
        normal=c.area * stress(strain, c, state),
        shear=scale(c.shear, strain.shear),
        torsion=c.torsion * strain.twist,
        bending=scale(c.bending, strain.bending),
    )


def energy(strain: Strain, c: Constants, state: State) -> float:
    """Return the elastic energy in J."""
    sigma = stress(strain, c, state)
    axial = c.area * sigma * sigma / (c.E * c.per_L)
    turning = c.torsion * strain.twist * strain.twist + c.bending * dot(strain.bending, strain.bending)
    return 0.5 * (axial + c.shear * dot(strain.shear, strain.shear) + turning)


def overload(strain: Strain, c: Constants, state: State) -> float:
    """Return the stress as a share of what the bond still bears."""
    return abs(stress(strain, c, state)) / (c.strength * (1.0 - state.weakness))


def on_event(strain: Strain, c: Constants, state: State, key: RandomKey) -> State:
    """Open by a random share of the stress, and weaken."""
    share = uniform(key.seed, key.bond, 0, int(state.overloads))
    opening = state.opening + share * stress(strain, c, state) / c.E
    return State(opening, state.weakness + c.weakening * (1.0 - state.weakness), state.overloads + 1.0)


def failure(strain: Strain, load: BondLoad, c: Constants, state: State) -> float:
    """Return the strain as a share of what breaks the bond."""
    return max(strain.axial * c.per_L * c.per_breakage, 0.0)


def mode(strain: Strain, load: BondLoad, c: Constants, state: State) -> int:
    """Return which of the modes broke it."""
    return 0


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the model."""
    registry.bond_model(
        "tiring",
        BondModel(
            summary="opens by random shares, weaker each time",
            Params=Tiring,
            Constants=Constants,
            constants=constants,
            stiffness=stiffness,
            load=load,
            failure=failure,
            mode=mode,
            energy=energy,
            modes=("tension",),
            State=State,
            overload=overload,
            on_event=on_event,
        ),
    )
