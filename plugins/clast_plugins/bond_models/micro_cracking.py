"""Model 3: micro-cracking bonds, whose stress drops by a random share each time it reaches the yield stress."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt
from typing import Annotated, Literal, NamedTuple

import numpy as np
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number
from clast.maths.counter_random import uniform
from clast.maths.vec3 import Vec, add, dot, norm, scale, sub
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, RandomKey, Stiffness, Strain
from clast.plugins.registry import Registry
from clast_plugins.bond_models import outer_fibre
from clast_plugins.bond_models.beam import beam_energy, beam_stiffness
from clast_plugins.bond_models.outer_fibre import Fibre, PlasticFibre, fibre_numbers, with_angles, with_moments, yielded
from clast_plugins.bond_models.strain_limit import MODES, elastic_part, failure, mode
from clast_plugins.bond_models.yielding import YieldingBond

NORMAL, SHEAR, TORSION, BENDING = 0, 1, 2, 3


class MicroCracking(YieldingBond):
    r"""Micro-cracking bond: at the yield stress the stress drops to a random share, then reloads elastically.

    Equation
    --------
    σ = E (ε − ε_p);  each time |σ| reaches σ_y:  σ → η σ_y,  η = w U(0, 1);  breaks when ε > ε_max

    Symbols
    -------
    ε_p : opening of the micro-cracks as a strain, grows by (1 − η) σ_y/E at each drop
    w : weakening factor
    The shear stress τ = G |γ − γ_p| drops likewise, with its own random numbers.

    Limits
    ------
    The reload stiffness and σ_y do not degrade. Moments stay elastic and never break a bond, unless ``moment_limit``
    (their stresses then drop likewise), ``breakage_strain_at`` or ``breakage_shear_strain`` say so: see
    ``outer_fibre.py``.

    Source
    ------
    Rotter, Dosta, Düster (2023), Eqs. 11–13, Fig. 5. At a drop the rest of the strain increment reloads elastically,
    so the curve does not depend on the time step; ``drop_from: trial`` takes η times the stress of the step, as the
    authors' program does. ``compressive_break`` is not in the paper: that program of the time used 2. Limits of
    moments are in neither.
    """

    weakening_factor: Annotated[Number, Field(gt=0, le=1, description="w: the drop leaves w U(0, 1) of the stress")] = (
        1.0
    )
    fixed_drop: Annotated[Number | None, Field(gt=0, lt=1, description="eta for every drop instead of random ones")] = (
        None
    )
    shear_drops: Annotated[bool, Field(description="whether the shear stress drops too")] = True
    drop_from: Annotated[
        Literal["yield", "trial"],
        Field(description="the stress that drops: sigma_y, or the trial stress of the step"),
    ] = "yield"
    seed: Annotated[int, Field(ge=0, lt=2**32, description="Seed of the random drops")] = 1


class Constants(NamedTuple):
    """Numbers of Model 3; ``per_L`` is 1/L0, ``fixed_drop`` is negative for random drops."""

    per_L: float
    E: float
    G: float
    A: float
    GJ: float
    EI: float
    yield_stress: float
    per_normal_yield: float
    per_shear_yield: float
    per_tensile_limit: float
    per_compressive_limit: float
    weakening_factor: float
    fixed_drop: float
    from_trial: float


class State(NamedTuple):
    """Opening of the micro-cracks as strains, and how many drops each stress has had."""

    axial_plastic: float
    shear_plastic: Vec
    normal_drops: float
    shear_drops: float


def constants(params: MicroCracking, bond: BondGeometry) -> Constants:
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
        yield_stress=params.yield_stress,
        per_normal_yield=1.0 / params.yield_stress,
        per_shear_yield=1.0 / params.yield_stress if params.shear_drops else 0.0,
        per_tensile_limit=1.0 / params.breakage_strain,
        per_compressive_limit=1.0 / (K * params.breakage_strain) if np.all(K) else 0.0,
        weakening_factor=params.weakening_factor,
        fixed_drop=-1.0 if params.fixed_drop is None else params.fixed_drop,
        from_trial=1.0 if params.drop_from == "trial" else 0.0,
    )


def stiffness(params: MicroCracking, bond: BondGeometry) -> Stiffness:
    """Return EA/L0, GA/L0, GJ/L0, EI/L0 of all bonds."""
    return beam_stiffness(params.young_modulus, params.poisson_ratio, bond)


def normal_stress(strain: Strain, c: Constants, state: State) -> float:
    """Return σ = E (ε − ε_p) in Pa."""
    return c.E * (c.per_L * strain.axial - state.axial_plastic)


def shear_stress(strain: Strain, c: Constants, state: State) -> Vec:
    """Return τ = G (γ − γ_p) in Pa."""
    return scale(c.G, sub(scale(c.per_L, strain.shear), state.shear_plastic))


def load(strain: Strain, c: Constants, state: State) -> BondLoad:
    """Stress times section, and elastic moments."""
    return BondLoad(
        normal=c.A * normal_stress(strain, c, state),
        shear=scale(c.A, shear_stress(strain, c, state)),
        torsion=c.GJ * c.per_L * strain.twist,
        bending=scale(c.EI * c.per_L, strain.bending),
    )


def overloads(strain: Strain, c: Constants, state: State) -> tuple[float, float]:
    """Return the squares of normal and shear stress, each as a share of the yield stress."""
    normal = normal_stress(strain, c, state) * c.per_normal_yield
    shear = scale(c.per_shear_yield, shear_stress(strain, c, state))
    return normal * normal, dot(shear, shear)


def overload(strain: Strain, c: Constants, state: State) -> float:
    """Return the larger of the two squares: above 1 a drop is due."""
    normal, shear = overloads(strain, c, state)
    return max(normal, shear)


def remaining_share(c: Constants, key: RandomKey, component: int, drops: float) -> float:
    """Return η of the next drop."""
    if c.fixed_drop > 0.0:
        return c.fixed_drop
    return c.weakening_factor * uniform(key.seed, key.bond, component, int(drops))


def on_event(strain: Strain, c: Constants, state: State, key: RandomKey) -> State:
    """Eq. 12: drop the more loaded of normal and shear stress to its remaining share."""
    normal, shear = overloads(strain, c, state)
    if normal >= shear:
        sigma = normal_stress(strain, c, state)
        share = remaining_share(c, key, NORMAL, state.normal_drops)
        drop = (1.0 - share) * (abs(sigma) if c.from_trial > 0.0 else c.yield_stress)
        opening = (drop if sigma > 0.0 else -drop) / c.E
        return State(state.axial_plastic + opening, state.shear_plastic, state.normal_drops + 1.0, state.shear_drops)
    tau = shear_stress(strain, c, state)
    size = norm(tau)
    share = remaining_share(c, key, SHEAR, state.shear_drops)
    drop = (1.0 - share) * (size if c.from_trial > 0.0 else c.yield_stress)
    sliding = scale(drop / (c.G * size), tau)
    return State(state.axial_plastic, add(state.shear_plastic, sliding), state.normal_drops, state.shear_drops + 1.0)


def energy(strain: Strain, c: Constants, state: State) -> float:
    """Return the elastic energy in J."""
    return beam_energy(elastic_part(strain, c, state), load(strain, c, state))


class FibreConstants(NamedTuple):
    """Numbers of Model 3 where it watches its outermost fibre."""

    axis: Constants
    fibre: Fibre


class FibreState(NamedTuple):
    """Opening of the micro-cracks on the axis and at the outermost fibre, and how many drops the moments have had."""

    axis: State
    fibre: PlasticFibre
    torsion_drops: float
    bending_drops: float


def fibre_constants(params: MicroCracking, bond: BondGeometry) -> FibreConstants:
    """Compute the constants of all bonds."""
    return FibreConstants(constants(params, bond), fibre_numbers(params, bond))


def fibre_load(strain: Strain, c: FibreConstants, state: FibreState) -> BondLoad:
    """Stress times section, moments included."""
    return with_moments(load(strain, c.axis, state.axis), strain, c.fibre, state.fibre)


def fibre_energy(strain: Strain, c: FibreConstants, state: FibreState) -> float:
    """Return the elastic energy in J."""
    elastic = with_angles(elastic_part(strain, c.axis, state.axis), strain, c.fibre, state.fibre)
    return beam_energy(elastic, fibre_load(strain, c, state))


def fibre_overload(strain: Strain, c: FibreConstants, state: FibreState) -> float:
    """Return the largest of the four squares: above 1 a drop is due."""
    torsion, bending = outer_fibre.overloads(strain, c.fibre, state.fibre)
    return max(overload(strain, c.axis, state.axis), torsion, bending)


def fibre_event(strain: Strain, c: FibreConstants, state: FibreState, key: RandomKey) -> FibreState:
    """Drop the most loaded of normal stress, shear stress, torsion and bending to its remaining share."""
    torsion, bending = outer_fibre.overloads(strain, c.fibre, state.fibre)
    if overload(strain, c.axis, state.axis) >= max(torsion, bending):
        axis = on_event(strain, c.axis, state.axis, key)
        return FibreState(axis, state.fibre, state.torsion_drops, state.bending_drops)
    if torsion >= bending:
        lost = lost_share(c.axis, torsion, remaining_share(c.axis, key, TORSION, state.torsion_drops))
        fibre = yielded(strain, c.fibre, state.fibre, lost, 0.0)
        return FibreState(state.axis, fibre, state.torsion_drops + 1.0, state.bending_drops)
    lost = lost_share(c.axis, bending, remaining_share(c.axis, key, BENDING, state.bending_drops))
    fibre = yielded(strain, c.fibre, state.fibre, 0.0, lost)
    return FibreState(state.axis, fibre, state.torsion_drops, state.bending_drops + 1.0)


def lost_share(c: Constants, overload: float, remaining: float) -> float:
    """Return the share of an elastic strain that a drop takes: 1 − η of the strain at the limit, or of all of it."""
    return (1.0 - remaining) * (1.0 if c.from_trial > 0.0 else 1.0 / sqrt(overload))


MODEL = BondModel(
    summary="Model 3: stress drops by random shares at the yield stress, breaks at a strain",
    Params=MicroCracking,
    Constants=Constants,
    constants=constants,
    stiffness=stiffness,
    load=load,
    failure=failure,
    mode=mode,
    energy=energy,
    modes=MODES,
    State=State,
    overload=overload,
    on_event=on_event,
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
    overload=fibre_overload,
    on_event=fibre_event,
)


def variant(params: MicroCracking) -> BondModel:
    """Return the law that watches its outermost fibre where that is asked for."""
    return FIBRE_MODEL if params.watches_fibre else MODEL


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer Model 3."""
    registry.bond_model("micro_cracking", replace(MODEL, variant=variant))
