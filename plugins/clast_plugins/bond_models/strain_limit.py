"""Breaking at an axial strain, with an optional limit in compression: what Models 2 and 3 share."""

from __future__ import annotations

from typing import Any, Protocol

from clast.maths.vec3 import Vec, scale, sub
from clast.parts.bond_model import BondLoad, Strain

MODES = ("strain in tension", "strain in compression")


class Limits(Protocol):
    """Numbers of a law that breaks at a strain; each inverse is 0 where there is no limit."""

    @property
    def per_L(self) -> float:
        """1/L0 in 1/m."""

    @property
    def per_tensile_limit(self) -> float:
        """1/ε_max."""

    @property
    def per_compressive_limit(self) -> float:
        """1/(K ε_max)."""


class PlasticStrains(Protocol):
    """State of a law with plastic strains."""

    @property
    def axial_plastic(self) -> float:
        """Plastic part of the axial strain."""

    @property
    def shear_plastic(self) -> Vec:
        """Plastic part of the shear strain."""


def failure(strain: Strain, load: BondLoad, c: Limits, state: Any) -> float:
    """Return the axial strain as a share of its limit; Rotter, Dosta, Düster (2023), Eq. 13."""
    axial = c.per_L * strain.axial
    return max(axial * c.per_tensile_limit, -axial * c.per_compressive_limit)


def mode(strain: Strain, load: BondLoad, c: Limits, state: Any) -> int:
    """Return 0 for a break by stretching, 1 by shortening."""
    return 0 if strain.axial > 0.0 else 1


def elastic_part(strain: Strain, c: Limits, state: PlasticStrains) -> Strain:
    """Return the strain measures less their plastic parts."""
    L0 = 1.0 / c.per_L
    return Strain(
        strain.axial - L0 * state.axial_plastic,
        sub(strain.shear, scale(L0, state.shear_plastic)),
        strain.twist,
        strain.bending,
    )
