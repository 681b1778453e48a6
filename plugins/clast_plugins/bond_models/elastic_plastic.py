"""Model 2: elastic, perfectly plastic bonds that break at a strain."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number, Stress
from clast.maths.vec3 import Vec, dot, scale, sub
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, Stiffness, Strain
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.bond_models.beam import beam_energy, beam_stiffness
from clast_plugins.bond_models.strain_limit import MODES, elastic_part, failure, mode


class ElasticPlastic(Params):
    r"""Elastic, perfectly plastic bond that breaks at a total axial strain.

    Equation
    --------
    ε = ε_e + ε_p,  σ = E (ε − ε_p) with |σ| ≤ σ_y;  likewise τ = G |γ − γ_p| ≤ σ_y;  breaks when ε > ε_max

    Symbols
    -------
    ε : axial strain (|d| − L0)/L0
    γ : shear strain, a vector across the bond
    ε_p, γ_p : plastic strains, the state of the bond

    Limits
    ------
    Normal and shear stress yield separately; moments stay elastic and never break a bond.

    Source
    ------
    Rotter, Dosta, Düster (2023), Eqs. 9–11 and 13. ``compressive_break`` is not in the paper: the authors' program of
    the time also broke bonds below −2 ε_max.
    """

    young_modulus: Annotated[Stress, Field(gt=0, description="Young's modulus E of the bond")]
    poisson_ratio: Annotated[Number, Field(gt=-1, lt=0.5, description="Poisson's ratio of the bond")]
    yield_stress: Annotated[Stress, Field(gt=0, description="Yield stress sigma_y, normal and shear")]
    breakage_strain: Annotated[Number, Field(gt=0, description="Axial strain at which the bond breaks, epsilon_max")]
    compressive_break: Annotated[
        Number, Field(ge=0, description="K: also breaks at an axial strain below -K epsilon_max; 0: never")
    ] = 0.0


class Constants(NamedTuple):
    """Numbers of Model 2; ``per_L`` is 1/L0."""

    per_L: float
    E: float
    G: float
    A: float
    GJ: float
    EI: float
    yield_strain: float
    yield_shear_strain: float
    per_tensile_limit: float
    per_compressive_limit: float


class State(NamedTuple):
    """Plastic strains: axial, and shear in the bond's material frame."""

    axial_plastic: float
    shear_plastic: Vec


def constants(params: ElasticPlastic, bond: BondGeometry) -> Constants:
    """Compute the constants of all bonds."""
    E, K = params.young_modulus, params.compressive_break
    G = E / (2.0 * (1.0 + params.poisson_ratio))
    return Constants(
        per_L=1.0 / bond.L0,
        E=E,
        G=G,
        A=bond.A,
        GJ=2.0 * G * bond.I,
        EI=E * bond.I,
        yield_strain=params.yield_stress / E,
        yield_shear_strain=params.yield_stress / G,
        per_tensile_limit=1.0 / params.breakage_strain,
        per_compressive_limit=0.0 if K == 0 else 1.0 / (K * params.breakage_strain),
    )


def stiffness(params: ElasticPlastic, bond: BondGeometry) -> Stiffness:
    """Return EA/L0, GA/L0, GJ/L0, EI/L0 of all bonds."""
    return beam_stiffness(params.young_modulus, params.poisson_ratio, bond)


def flow(strain: Strain, c: Constants, state: State) -> State:
    """Radial return: elastic strain beyond yield becomes plastic, normal and shear each for itself."""
    elastic = c.per_L * strain.axial - state.axial_plastic
    kept = min(max(elastic, -c.yield_strain), c.yield_strain)
    shear = sub(scale(c.per_L, strain.shear), state.shear_plastic)
    size = sqrt(dot(shear, shear))
    excess = 1.0 - c.yield_shear_strain / max(size, c.yield_shear_strain)
    return State(
        axial_plastic=state.axial_plastic + (elastic - kept),
        shear_plastic=sub(state.shear_plastic, scale(-excess, shear)),
    )


def load(strain: Strain, c: Constants, state: State) -> BondLoad:
    """Eqs. 9–10: stiffness times elastic strain."""
    return BondLoad(
        normal=c.E * c.A * (c.per_L * strain.axial - state.axial_plastic),
        shear=scale(c.G * c.A, sub(scale(c.per_L, strain.shear), state.shear_plastic)),
        torsion=c.GJ * c.per_L * strain.twist,
        bending=scale(c.EI * c.per_L, strain.bending),
    )


def energy(strain: Strain, c: Constants, state: State) -> float:
    """Return the elastic energy in J."""
    return beam_energy(elastic_part(strain, c, state), load(strain, c, state))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer Model 2."""
    registry.bond_model(
        "elastic_plastic",
        BondModel(
            summary="Model 2: elastic, perfectly plastic, breaks at a strain",
            Params=ElasticPlastic,
            Constants=Constants,
            constants=constants,
            stiffness=stiffness,
            load=load,
            failure=failure,
            mode=mode,
            energy=energy,
            modes=MODES,
            State=State,
            flow=flow,
        ),
    )
