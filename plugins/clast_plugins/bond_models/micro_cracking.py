"""Model 3: micro-cracking bonds, whose stress drops by a random share each time it reaches the yield stress."""

from __future__ import annotations

from typing import Annotated, Literal, NamedTuple

from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number, Stress
from clast.maths.counter_random import uniform
from clast.maths.vec3 import Vec, add, dot, norm, scale, sub
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, RandomKey, Stiffness, Strain
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.bond_models.beam import beam_energy, beam_stiffness
from clast_plugins.bond_models.strain_limit import MODES, elastic_part, failure, mode

NORMAL, SHEAR = 0, 1


class MicroCracking(Params):
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
    Moments stay elastic and never break a bond; the reload stiffness and σ_y do not degrade.

    Source
    ------
    Rotter, Dosta, Düster (2023), Eqs. 11–13, Fig. 5. At a drop the rest of the strain increment reloads elastically,
    so the curve does not depend on the time step; ``drop_from: trial`` takes η times the stress of the step, as the
    authors' program does. ``compressive_break`` is not in the paper: that program of the time used 2.
    """

    young_modulus: Annotated[Stress, Field(gt=0, description="Young's modulus E of the bond")]
    poisson_ratio: Annotated[Number, Field(gt=-1, lt=0.5, description="Poisson's ratio of the bond")]
    yield_stress: Annotated[Stress, Field(gt=0, description="Stress sigma_y at which a micro-crack opens")]
    breakage_strain: Annotated[Number, Field(gt=0, description="Axial strain at which the bond breaks, epsilon_max")]
    compressive_break: Annotated[
        Number, Field(ge=0, description="K: also breaks at an axial strain below -K epsilon_max; 0: never")
    ] = 0.0
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
        per_compressive_limit=0.0 if K == 0 else 1.0 / (K * params.breakage_strain),
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


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer Model 3."""
    registry.bond_model(
        "micro_cracking",
        BondModel(
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
        ),
    )
