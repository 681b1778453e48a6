"""Model 1: linear elastic bonds that break at a normal or a shear strength."""

from __future__ import annotations

from typing import NamedTuple

from clast import hookimpl
from clast.maths.vec3 import norm, scale
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, Stiffness, Strain
from clast.plugins.registry import Registry
from clast_plugins.bond_models.beam import beam_energy, beam_stiffness
from clast_plugins.bond_models.strength import MODES, BrittleBond, shares


class Elastic(BrittleBond):
    r"""Linear elastic bond with separate normal and shear strengths.

    Equation
    --------
    σ = s |F_n|/A + |M_b| R/I,  τ = |F_t|/A + |M_t| R/J;  breaks when σ ≥ σ_br or τ ≥ τ_br

    Symbols
    -------
    F_n, F_t, M_b, M_t : normal and shear force, bending and torsion moment, each stiffness times strain measure
    s : +1 in tension, −1 in compression (``normal_term: tension``) or always +1 (``absolute``)

    Limits
    ------
    Undamped and brittle: how many bonds break in a cascade is decided by dynamics; see ``bonds.damping``.

    Source
    ------
    Rotter, Dosta, Düster (2023), Eqs. 3–8; the sign s as in the authors' program, which the paper prints as +1.
    """


class Constants(NamedTuple):
    """Numbers of Model 1; ``per_L`` is 1/L0, W and W_t the section moduli I/R and J/R."""

    per_L: float
    EA: float
    GA: float
    GJ: float
    EI: float
    A: float
    W: float
    W_t: float
    per_normal_strength: float
    per_shear_strength: float
    compression_sign: float


def constants(params: BrittleBond, bond: BondGeometry) -> Constants:
    """Compute the constants of all bonds."""
    E, J = params.young_modulus, 2.0 * bond.I
    G = E / (2.0 * (1.0 + params.poisson_ratio))
    return Constants(
        per_L=1.0 / bond.L0,
        EA=E * bond.A,
        GA=G * bond.A,
        GJ=G * J,
        EI=E * bond.I,
        A=bond.A,
        W=bond.I / bond.R,
        W_t=J / bond.R,
        per_normal_strength=1.0 / params.normal_strength,
        per_shear_strength=params.per_shear_strength,
        compression_sign=params.compression_sign,
    )


def stiffness(params: BrittleBond, bond: BondGeometry) -> Stiffness:
    """Return EA/L0, GA/L0, GJ/L0, EI/L0 of all bonds."""
    return beam_stiffness(params.young_modulus, params.poisson_ratio, bond)


def load(strain: Strain, c: Constants, state: None) -> BondLoad:
    """Eqs. 3–6 on total strains: stiffness times strain measure."""
    return BondLoad(
        normal=c.EA * c.per_L * strain.axial,
        shear=scale(c.GA * c.per_L, strain.shear),
        torsion=c.GJ * c.per_L * strain.twist,
        bending=scale(c.EI * c.per_L, strain.bending),
    )


def fibre_shares(load: BondLoad, c: Constants) -> tuple[float, float]:
    """Return normal and shear stress of the outermost fibre, each as a share of its strength; Eqs. 7–8."""
    return shares(load.normal, norm(load.shear), load.torsion, norm(load.bending), c)


def failure(strain: Strain, load: BondLoad, c: Constants, state: None) -> float:
    """Return the larger of the two stresses, each as a share of its strength."""
    normal, shear = fibre_shares(load, c)
    return max(normal, shear)


def mode(strain: Strain, load: BondLoad, c: Constants, state: None) -> int:
    """Return 0 for a break in tension, 1 in shear."""
    normal, shear = fibre_shares(load, c)
    return 1 if shear > normal else 0


def energy(strain: Strain, c: Constants, state: None) -> float:
    """Return half of load times strain in J."""
    return beam_energy(strain, load(strain, c, state))


MODEL = BondModel(
    summary="Model 1: linear elastic, breaks at a normal or shear strength",
    Params=Elastic,
    Constants=Constants,
    constants=constants,
    stiffness=stiffness,
    load=load,
    failure=failure,
    mode=mode,
    energy=energy,
    modes=MODES,
)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer Model 1."""
    registry.bond_model("elastic", MODEL)
