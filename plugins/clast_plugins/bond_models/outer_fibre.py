r"""The outermost fibre of a bond: what Models 2 and 3 add when bending and torsion yield or break.

Equation
--------
ε_b = R θ_b/L0 − ε_bp,  M_b = (I/R) E ε_b with |M_b| ≤ s_b σ_y I/R
γ_t = R θ_t/L0 − γ_tp,  M_t = (J/R) G γ_t with |M_t| ≤ s_t σ_y J/R
breaks when ε ± R |θ_b|/L0 passes a limit of the strain, or |γ| + R |θ_t|/L0 reaches γ_max

Symbols
-------
θ_b, θ_t : bending (a vector) and twist in rad
ε_b, γ_t : their elastic strains at the outermost fibre; ε_bp, γ_tp : the plastic ones, part of the bond's state
s_b, s_t : 1 when the outermost fibre is at σ_y; 16/(3π) and 4/3 when the full section is, so that the moments are
    4/3 R³ σ_y and 2/3 π R³ σ_y

Limits
------
Bending and torsion yield each for itself, as normal and shear stress do: no interaction of the four. Under moments
alone ``full_section`` is the exact limit of an elastic, perfectly plastic cylinder and ``outer_fibre`` is where that
begins to yield; the rounded curve between the two is left out. Torsion yields at the same σ_y as bending.

Source
------
Moments of a section: W. Prager, P. G. Hodge, Theory of Perfectly Plastic Solids, Wiley (1951). Return mapping:
J. C. Simo, T. J. R. Hughes, Computational Inelasticity, Springer (1998), doi:10.1007/b98904. Not in Rotter, Dosta,
Düster (2023).
"""

from __future__ import annotations

from math import pi, sqrt
from typing import Any, NamedTuple, Protocol

from clast.maths.vec3 import Vec, add, dot, norm, scale, sub
from clast.parts.bond_model import BondGeometry, BondLoad, Strain
from clast_plugins.bond_models import strain_limit
from clast_plugins.bond_models.strain_limit import Limits
from clast_plugins.bond_models.yielding import YieldingBond

MODES = (*strain_limit.MODES, "strain in bending", "strain in shear", "strain in torsion")
TENSION, COMPRESSION, BENDING, SHEAR, TORSION = range(5)
SHAPE_FACTORS = {"outer_fibre": (1.0, 1.0), "full_section": (16.0 / (3.0 * pi), 4.0 / 3.0)}


class Fibre(NamedTuple):
    """Numbers of the outermost fibre; each inverse is 0 where there is no limit.

    Attributes
    ----------
    R_per_L : float
        R/L0, what makes an angle the strain of the outermost fibre.
    bending_modulus, torsion_modulus : float
        E I/R and G J/R in N m, what makes that strain a moment.
    per_bending_yield, per_torsion_yield : float
        1/ε_b and 1/γ_t at the limit of the moment.
    per_shear_limit : float
        1/γ_max.
    surface : float
        1 when breakage sees bending and torsion, 0 when it does not.
    """

    R_per_L: float
    bending_modulus: float
    torsion_modulus: float
    per_bending_yield: float
    per_torsion_yield: float
    per_shear_limit: float
    surface: float


class PlasticFibre(NamedTuple):
    """Plastic strains of the outermost fibre: by torsion, and by bending along the axis it is bent about."""

    torsion: float
    bending: Vec


class FibreConstants(Protocol):
    """Constants of a law that watches its outermost fibre."""

    @property
    def axis(self) -> Limits:
        """What the law knows of its axis."""

    @property
    def fibre(self) -> Fibre:
        """What it knows of its outermost fibre."""


def fibre_numbers(params: YieldingBond, bond: BondGeometry) -> Fibre:
    """Compute the numbers of all bonds."""
    E, sigma_y, W = params.young_modulus, params.yield_stress, bond.I / bond.R
    G = E / (2.0 * (1.0 + params.poisson_ratio))
    shapes = SHAPE_FACTORS.get(params.moment_limit)
    gamma_max = params.breakage_shear_strain
    return Fibre(
        R_per_L=bond.R / bond.L0,
        bending_modulus=E * W,
        torsion_modulus=2.0 * G * W,
        per_bending_yield=0.0 if shapes is None else E / (shapes[0] * sigma_y),
        per_torsion_yield=0.0 if shapes is None else G / (shapes[1] * sigma_y),
        per_shear_limit=0.0 if gamma_max is None else 1.0 / gamma_max,
        surface=1.0 if params.breakage_strain_at == "outer_fibre" else 0.0,
    )


def bending_strain(strain: Strain, c: Fibre, state: PlasticFibre) -> Vec:
    """Return the elastic strain of the outermost fibre by bending."""
    return sub(scale(c.R_per_L, strain.bending), state.bending)


def torsion_strain(strain: Strain, c: Fibre, state: PlasticFibre) -> float:
    """Return the elastic shear strain of the outermost fibre by torsion."""
    return c.R_per_L * strain.twist - state.torsion


def overloads(strain: Strain, c: Fibre, state: PlasticFibre) -> tuple[float, float]:
    """Return the squares of torsion and bending moment, each as a share of its limit."""
    torsion = c.per_torsion_yield * torsion_strain(strain, c, state)
    bending = scale(c.per_bending_yield, bending_strain(strain, c, state))
    return torsion * torsion, dot(bending, bending)


def yielded(strain: Strain, c: Fibre, state: PlasticFibre, torsion: float, bending: float) -> PlasticFibre:
    """Let these shares of the elastic strains by torsion and by bending become plastic."""
    return PlasticFibre(
        torsion=state.torsion + torsion * torsion_strain(strain, c, state),
        bending=add(state.bending, scale(bending, bending_strain(strain, c, state))),
    )


def plastic_flow(strain: Strain, c: Fibre, state: PlasticFibre) -> PlasticFibre:
    """Radial return of torsion and bending to their limits, each for itself."""
    torsion, bending = overloads(strain, c, state)
    return yielded(strain, c, state, excess(torsion), excess(bending))


def excess(overload: float) -> float:
    """Return the share of an elastic strain that lies beyond its limit."""
    return 1.0 - 1.0 / sqrt(max(overload, 1.0))


def with_moments(load: BondLoad, strain: Strain, c: Fibre, state: PlasticFibre) -> BondLoad:
    """Return a load whose moments are those of the elastic strains of the outermost fibre."""
    torsion = c.torsion_modulus * torsion_strain(strain, c, state)
    bending = scale(c.bending_modulus, bending_strain(strain, c, state))
    return BondLoad(load.normal, load.shear, torsion, bending)


def with_angles(elastic: Strain, strain: Strain, c: Fibre, state: PlasticFibre) -> Strain:
    """Return elastic strain measures whose angles are those of the elastic strains of the outermost fibre."""
    L_per_R = 1.0 / c.R_per_L
    twist = L_per_R * torsion_strain(strain, c, state)
    bending = scale(L_per_R, bending_strain(strain, c, state))
    return Strain(elastic.axial, elastic.shear, twist, bending)


def surface_strains(strain: Strain, c: Fibre) -> tuple[float, float]:
    """Return the strain by bending and the shear strain by twist that breakage sees."""
    return c.surface * c.R_per_L * norm(strain.bending), c.surface * c.R_per_L * abs(strain.twist)


def shares(strain: Strain, axis: Limits, fibre: Fibre) -> tuple[float, float, float]:
    """Return the largest tension, compression and shear strain, each as a share of its limit."""
    bent, twisted = surface_strains(strain, fibre)
    epsilon, gamma = axis.per_L * strain.axial, axis.per_L * norm(strain.shear)
    return (
        (bent + epsilon) * axis.per_tensile_limit,
        (bent - epsilon) * axis.per_compressive_limit,
        (twisted + gamma) * fibre.per_shear_limit,
    )


def failure(strain: Strain, load: BondLoad, c: FibreConstants, state: Any) -> float:
    """Return the largest of the three shares."""
    tension, compression, shear = shares(strain, c.axis, c.fibre)
    return max(tension, compression, shear)


def mode(strain: Strain, load: BondLoad, c: FibreConstants, state: Any) -> int:
    """Return which limit was passed, and of the two strains that add up there the larger one."""
    tension, compression, shear = shares(strain, c.axis, c.fibre)
    bent, twisted = surface_strains(strain, c.fibre)
    if shear > max(tension, compression):
        return TORSION if twisted > c.axis.per_L * norm(strain.shear) else SHEAR
    if bent > c.axis.per_L * abs(strain.axial):
        return BENDING
    return TENSION if strain.axial > 0.0 else COMPRESSION
