"""Model 2: elastic, perfectly plastic bonds that break at a strain."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt
from typing import NamedTuple

import numpy as np

from clast import hookimpl
from clast.maths.vec3 import Vec, dot, scale, sub
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, Stiffness, Strain
from clast.plugins.registry import Registry
from clast_plugins.bond_models import outer_fibre
from clast_plugins.bond_models.beam import beam_energy, beam_stiffness
from clast_plugins.bond_models.outer_fibre import (
    Fibre,
    PlasticFibre,
    fibre_numbers,
    plastic_flow,
    with_angles,
    with_moments,
)
from clast_plugins.bond_models.strain_limit import MODES, elastic_part, failure, mode
from clast_plugins.bond_models.yielding import YieldingBond


class ElasticPlastic(YieldingBond):
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
    Normal and shear stress yield separately; moments stay elastic and never break a bond, unless ``moment_limit``,
    ``breakage_strain_at`` or ``breakage_shear_strain`` say so: see ``outer_fibre.py``.

    Source
    ------
    Rotter, Dosta, Düster (2023), Eqs. 9–11 and 13. ``compressive_break`` is not in the paper: the authors' program of
    the time also broke bonds below −2 ε_max. Nor are limits of moments, in the paper or in that program.
    """


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
        per_compressive_limit=1.0 / (K * params.breakage_strain) if np.all(K) else 0.0,
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


class FibreConstants(NamedTuple):
    """Numbers of Model 2 where it watches its outermost fibre."""

    axis: Constants
    fibre: Fibre


class FibreState(NamedTuple):
    """Plastic strains of the axis and of the outermost fibre."""

    axis: State
    fibre: PlasticFibre


def fibre_constants(params: ElasticPlastic, bond: BondGeometry) -> FibreConstants:
    """Compute the constants of all bonds."""
    return FibreConstants(constants(params, bond), fibre_numbers(params, bond))


def fibre_flow(strain: Strain, c: FibreConstants, state: FibreState) -> FibreState:
    """Radial return of normal stress, shear stress, torsion and bending, each for itself."""
    return FibreState(flow(strain, c.axis, state.axis), plastic_flow(strain, c.fibre, state.fibre))


def fibre_load(strain: Strain, c: FibreConstants, state: FibreState) -> BondLoad:
    """Stiffness times elastic strain, moments included."""
    return with_moments(load(strain, c.axis, state.axis), strain, c.fibre, state.fibre)


def fibre_energy(strain: Strain, c: FibreConstants, state: FibreState) -> float:
    """Return the elastic energy in J."""
    elastic = with_angles(elastic_part(strain, c.axis, state.axis), strain, c.fibre, state.fibre)
    return beam_energy(elastic, fibre_load(strain, c, state))


MODEL = BondModel(
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
)
FIBRE_MODEL = replace(
    MODEL,
    Constants=FibreConstants,
    constants=fibre_constants,
    load=fibre_load,
    failure=outer_fibre.failure,
    mode=outer_fibre.mode,
    energy=fibre_energy,
    modes=outer_fibre.MODES,
    State=FibreState,
    flow=fibre_flow,
)


def variant(params: ElasticPlastic) -> BondModel:
    """Return the law that watches its outermost fibre where that is asked for."""
    return FIBRE_MODEL if params.watches_fibre else MODEL


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer Model 2."""
    registry.bond_model("elastic_plastic", replace(MODEL, variant=variant))
