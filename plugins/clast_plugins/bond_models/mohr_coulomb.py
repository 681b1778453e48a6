"""Parallel bond: elastic, and broken by tension or by shear, which pressure helps to withstand."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Angle, Number, Stress
from clast.maths.vec3 import norm
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, Stiffness, Strain
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.bond_models.beam import Springs, beam_energy, cylinder_stiffness, spring_load
from clast_plugins.bond_models.strength import MODES


class MohrCoulomb(Params):
    r"""Elastic bond that breaks at a tensile strength or at the shear strength of Mohr and Coulomb.

    Equation
    --------
    N = k_n A u,  T = k_s A w,  M_t = k_s J θ_t,  M_b = k_n I θ_b,  k_n = E*/L0,  k_s = k_n/κ
    σ = N/A + β |M_b| R/I,  τ = |T|/A + β |M_t| R/J;  breaks when σ ≥ σ_c or τ ≥ c − N/A tan φ

    Symbols
    -------
    u, w, θ_t, θ_b : elongation, displacement across, twist and bending
    k_n, k_s : stiffness for each area of the section in Pa/m
    κ : ratio of normal to shear stiffness
    σ_c, c, φ : tensile strength, cohesion, angle of friction; N is positive in tension
    β : share of the moments that counts in the stresses

    Limits
    ------
    Pressure never breaks a bond by itself, and what it adds to the shear strength has no cap. A broken bond leaves the
    contact of its particles, with the friction of their materials; φ is that of the bond alone.

    Source
    ------
    Parallel bond: D. O. Potyondy, P. A. Cundall (2004), International Journal of Rock Mechanics and Mining Sciences
    41, 1329–1364, doi:10.1016/j.ijrmms.2004.09.011, whose shear strength is the cohesion alone (φ = 0, β = 1). Share of
    the moments: D. O. Potyondy (2011), Parallel-bond refinements to match macroproperties of hard rock, Proc. 2nd
    International FLAC/DEM Symposium, Itasca. Friction: linear parallel bond of Itasca's PFC.
    """

    effective_modulus: Annotated[Stress, Field(gt=0, examples=["500 MPa"], description="Modulus E*: k_n is E*/L0")]
    stiffness_ratio: Annotated[
        Number, Field(gt=0, examples=[2.5], description="kappa: normal over shear stiffness, k_n/k_s")
    ]
    tensile_strength: Annotated[
        Stress, Field(gt=0, examples=["4 MPa"], description="Strength against tension and bending, sigma_c")
    ]
    cohesion: Annotated[
        Stress, Field(gt=0, examples=["6 MPa"], description="Shear strength where nothing presses or pulls, c")
    ]
    friction_angle: Annotated[
        Angle, Field(ge=0, lt=np.pi / 2, examples=["30 deg"], description="Angle phi; pressure p adds p tan(phi)")
    ]
    moment_contribution: Annotated[
        Number, Field(ge=0, le=1, description="beta: share of the moments that counts in the stresses")
    ] = 1.0


class Constants(NamedTuple):
    """Numbers of one bond; ``per_W`` and ``per_W_t`` are β R/I and β R/J, ``friction`` is tan φ."""

    k: Springs
    per_A: float
    per_W: float
    per_W_t: float
    per_tensile_strength: float
    per_cohesion: float
    friction: float


def stiffness(params: MohrCoulomb, bond: BondGeometry) -> Stiffness:
    """Return k_n A, k_s A, k_s J, k_n I of all bonds."""
    return cylinder_stiffness(params.effective_modulus, params.effective_modulus / params.stiffness_ratio, bond)


def constants(params: MohrCoulomb, bond: BondGeometry) -> Constants:
    """Compute the constants of all bonds."""
    return Constants(
        k=Springs._make(stiffness(params, bond)),
        per_A=1.0 / bond.A,
        per_W=params.moment_contribution * bond.R / bond.I,
        per_W_t=params.moment_contribution * bond.R / (2.0 * bond.I),
        per_tensile_strength=1.0 / params.tensile_strength,
        per_cohesion=1.0 / params.cohesion,
        friction=np.tan(params.friction_angle),
    )


def load(strain: Strain, c: Constants, state: None) -> BondLoad:
    """Return stiffness times strain measure."""
    return spring_load(strain, c.k)


def shares(load: BondLoad, c: Constants) -> tuple[float, float]:
    """Return what tension uses of its strength, and shear of the cohesion; both are 1 on the envelope of failure."""
    sigma = load.normal * c.per_A
    bent, twisted = norm(load.bending) * c.per_W, abs(load.torsion) * c.per_W_t
    tau = norm(load.shear) * c.per_A + twisted
    return (sigma + bent) * c.per_tensile_strength, (tau + c.friction * sigma) * c.per_cohesion


def failure(strain: Strain, load: BondLoad, c: Constants, state: None) -> float:
    """Return the larger of the two shares, 0 where pressure makes both negative."""
    tension, shear = shares(load, c)
    return max(tension, shear, 0.0)


def mode(strain: Strain, load: BondLoad, c: Constants, state: None) -> int:
    """Return 0 for a break in tension, 1 in shear."""
    tension, shear = shares(load, c)
    return 1 if shear > tension else 0


def energy(strain: Strain, c: Constants, state: None) -> float:
    """Return half of load times strain in J."""
    return beam_energy(strain, load(strain, c, state))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the parallel bond."""
    registry.bond_model(
        "mohr_coulomb",
        BondModel(
            summary="parallel bond: elastic, breaks in tension or by Mohr and Coulomb's shear strength",
            Params=MohrCoulomb,
            Constants=Constants,
            constants=constants,
            stiffness=stiffness,
            load=load,
            failure=failure,
            mode=mode,
            energy=energy,
            modes=MODES,
        ),
    )
