"""Timoshenko beam: elastic bonds whose sideways stiffness knows that a bond bends between its ends."""

from __future__ import annotations

from math import sqrt
from typing import Annotated, NamedTuple

import numpy as np
from pydantic import Field

from clast import hookimpl
from clast.config.quantities import Number
from clast.maths.vec3 import cross, dot, norm
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, Stiffness, Strain
from clast.plugins.registry import Registry
from clast_plugins.bond_models.beam import Springs, beam_energy, beam_stiffness, spring_load
from clast_plugins.bond_models.strength import MODES, BrittleBond, shares


class Timoshenko(BrittleBond):
    r"""Elastic beam that bends and shears along its length and breaks at the stress of its outermost fibre.

    Equation
    --------
    N = EA/L0 u,  T = 12 EI/(L0³ (1 + Φ)) w,  M_t = GJ/L0 θ_t,  M_b = EI/L0 θ_b,  Φ = 12 EI/(κ G A L0²)
    σ = s |N|/A + |M_e| R/I,  τ = |T|/A + |M_t| R/J;  breaks when σ ≥ σ_br or τ ≥ τ_br
    |M_e|² = |M_b|² + (L0/2)² |T|² + L0 |T x M_b|

    Symbols
    -------
    u, w, θ_t, θ_b : the strain measures: elongation; displacement across the bond against the mean rotation of both
        ends; rotation of one end against the other, about the bond and across it
    κ : shear coefficient of the section, 6 (1 + ν)/(7 + 6 ν) for a cylinder
    M_e : bending moment at the end where it is larger; M_b is that in the middle, and T changes it by L0/2 T to
        either side
    s : +1 in tension, −1 in compression (``normal_term: tension``) or always +1 (``absolute``)

    Options
    -------
    ``shear_coefficient`` sets κ, for other sections; slender bonds hardly feel it.

    Limits
    ------
    Small strains of the beam itself; rotations of the bond as a whole may be large. That pressing a bond softens it
    against bending is not in the law of one bond; a row of them buckles.

    Source
    ------
    Stiffness: J. S. Przemieniecki, Theory of Matrix Structural Analysis, McGraw-Hill (1968), Chapter 5; shear
    coefficient: G. R. Cowper (1966), Journal of Applied Mechanics 33, 335–340, doi:10.1115/1.3625046.
    """

    shear_coefficient: Annotated[
        Number | None, Field(gt=0, le=1, description="kappa; none: that of Cowper for a cylinder")
    ] = None


class Constants(NamedTuple):
    """Numbers of one bond; W and W_t are the section moduli I/R and J/R."""

    k: Springs
    L0: float
    A: float
    W: float
    W_t: float
    per_normal_strength: float
    per_shear_strength: float
    compression_sign: float


def shear_coefficient(nu: float) -> float:
    """Return κ = 6 (1 + ν)/(7 + 6 ν) of a cylinder, Cowper (1966).

    >>> shear_coefficient(0.0) == 6.0 / 7.0
    True
    """
    return 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu)


def stiffness(params: Timoshenko, bond: BondGeometry) -> Stiffness:
    """Return EA/L0, 12 EI/(L0³ (1 + Φ)), GJ/L0, EI/L0 of all bonds."""
    plain = beam_stiffness(params.young_modulus, params.poisson_ratio, bond)
    given = params.shear_coefficient
    kappa = shear_coefficient(params.poisson_ratio) if given is None else given
    bent, sheared = 12.0 * plain.bending / np.asarray(bond.L0) ** 2, kappa * plain.shear
    return plain._replace(shear=bent / (1.0 + bent / sheared))


def constants(params: Timoshenko, bond: BondGeometry) -> Constants:
    """Compute the constants of all bonds."""
    return Constants(
        k=Springs._make(stiffness(params, bond)),
        L0=bond.L0,
        A=bond.A,
        W=bond.I / bond.R,
        W_t=2.0 * bond.I / bond.R,
        per_normal_strength=1.0 / params.normal_strength,
        per_shear_strength=params.per_shear_strength,
        compression_sign=params.compression_sign,
    )


def load(strain: Strain, c: Constants, state: None) -> BondLoad:
    """Return stiffness times strain measure."""
    return spring_load(strain, c.k)


def end_moment(load: BondLoad, c: Constants) -> float:
    """Return the larger of the bending moments at both ends in N m.

    Both are M_b ± L0/2 n x T. Shear force and moment lie across the axis n, so |n x T| is |T| and M_b · (n x T) is
    ± |T x M_b|.
    """
    by_shear = 0.25 * c.L0 * c.L0 * dot(load.shear, load.shear)
    both = c.L0 * norm(cross(load.shear, load.bending))
    return sqrt(dot(load.bending, load.bending) + by_shear + both)


def fibre_shares(load: BondLoad, c: Constants) -> tuple[float, float]:
    """Return normal and shear stress of the outermost fibre, each as a share of its strength."""
    return shares(load.normal, norm(load.shear), load.torsion, end_moment(load, c), c)


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


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the Timoshenko beam."""
    registry.bond_model(
        "timoshenko",
        BondModel(
            summary="elastic beam with bending and shear along its length, breaks at a normal or shear strength",
            Params=Timoshenko,
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
