"""What bond models share: a cylinder that stretches, shears, twists and bends."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from clast.maths.vec3 import dot, scale
from clast.parts.bond_model import BondGeometry, BondLoad, Stiffness, Strain


def cylinder_stiffness(E: float, G: float, bond: BondGeometry) -> Stiffness:
    """Return EA/L0, GA/L0, GJ/L0, EI/L0 of all bonds, with J = 2I."""
    per_L = 1.0 / np.asarray(bond.L0)
    return Stiffness(E * bond.A * per_L, G * bond.A * per_L, G * 2.0 * bond.I * per_L, E * bond.I * per_L)


def beam_stiffness(E: float, nu: float, bond: BondGeometry) -> Stiffness:
    """Return EA/L0, GA/L0, GJ/L0, EI/L0 of all bonds, with G = E/(2(1+ν)) and J = 2I.

    Source: Rotter, Dosta, Düster (2023), Eqs. 3–6.
    """
    return cylinder_stiffness(E, E / (2.0 * (1.0 + nu)), bond)


class Springs(NamedTuple):
    """Stiffness of one bond against each strain measure, as constants of a law: N/m, N/m, N m/rad, N m/rad."""

    axial: float
    shear: float
    torsion: float
    bending: float


def spring_load(strain: Strain, k: Springs) -> BondLoad:
    """Return stiffness times strain measure."""
    return BondLoad(
        normal=k.axial * strain.axial,
        shear=scale(k.shear, strain.shear),
        torsion=k.torsion * strain.twist,
        bending=scale(k.bending, strain.bending),
    )


def beam_energy(strain: Strain, load: BondLoad) -> float:
    """Return ½ load · strain in J, for elastic strains and the loads they cause."""
    return 0.5 * (
        load.normal * strain.axial
        + dot(load.shear, strain.shear)
        + load.torsion * strain.twist
        + dot(load.bending, strain.bending)
    )
