"""Closed forms of bonds as beams: one of them, and a cantilever that consists of them.

Sources: the stiffnesses are Eqs. 3–6 of Rotter, Dosta and Düster (2023), doi:10.1007/s40571-023-00610-0; the
continuous cantilever is that of S. P. Timoshenko with the shear coefficient 1, which the bonds have.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi


@dataclass(frozen=True)
class Beam:
    """A cylinder between two centres.

    Attributes
    ----------
    E : float
        Young's modulus in Pa.
    nu : float
        Poisson's ratio.
    R, L : float
        Radius and length in m.

    Examples
    --------
    The pair of the test suite of Kratos, drawn apart by 1 µm:

    >>> round(1e-6 * Beam(E=1e9, nu=0.2, R=1.0, L=2.0).axial, 1)
    1570.8
    """

    E: float
    nu: float
    R: float
    L: float

    @property
    def G(self) -> float:
        """Shear modulus E/(2 (1 + ν)) in Pa."""
        return self.E / (2.0 * (1.0 + self.nu))

    @property
    def A(self) -> float:
        """Section πR² in m²."""
        return pi * self.R**2

    @property
    def I(self) -> float:  # noqa: E743
        """Second moment of area πR⁴/4 in m⁴; J is twice as much."""
        return 0.25 * pi * self.R**4

    @property
    def axial(self) -> float:
        """EA/L in N/m."""
        return self.E * self.A / self.L

    @property
    def shear(self) -> float:
        """GA/L in N/m."""
        return self.G * self.A / self.L

    @property
    def torsion(self) -> float:
        """GJ/L in N m/rad."""
        return 2.0 * self.G * self.I / self.L

    @property
    def bending(self) -> float:
        """EI/L in N m/rad."""
        return self.E * self.I / self.L
