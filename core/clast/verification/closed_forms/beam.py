"""Closed forms of bonds as beams: one of them, and a cantilever that consists of them.

Sources: the stiffnesses are Eqs. 3–6 of Rotter, Dosta and Düster (2023), doi:10.1007/s40571-023-00610-0; the
continuous cantilever is that of S. P. Timoshenko. Bonds that are cylinders have the shear coefficient 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


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
    def cowper(self) -> float:
        """Shear coefficient κ = 6 (1 + ν)/(7 + 6 ν): G. R. Cowper (1966), doi:10.1115/1.3625046."""
        return 6.0 * (1.0 + self.nu) / (7.0 + 6.0 * self.nu)

    @property
    def bent_and_sheared(self) -> float:
        """12 EI/(L³ (1 + Φ)), Φ = 12 EI/(κ G A L²), in N/m: against moving one end across, neither end turning."""
        return 1.0 / (self.L**2 / (12.0 * self.bending) + 1.0 / (self.cowper * self.shear))

    @property
    def torsion(self) -> float:
        """GJ/L in N m/rad."""
        return 2.0 * self.G * self.I / self.L

    @property
    def bending(self) -> float:
        """EI/L in N m/rad."""
        return self.E * self.I / self.L


@dataclass(frozen=True)
class Cantilever:
    """A row of equal bonds, held at one end; the spheres between them are rigid.

    Attributes
    ----------
    bond : Beam
        One bond.
    n : int
        Number of bonds.

    Examples
    --------
    Many bonds bend and shear as Timoshenko's beam does:

    >>> beam = Cantilever(Beam(E=1e9, nu=0.25, R=1e-4, L=1e-5), n=1000)
    >>> round(beam.deflection(1e-6) / beam.timoshenko(1e-6), 6)
    1.0
    """

    bond: Beam
    n: int

    @property
    def length(self) -> float:
        """Length of the row in m."""
        return self.n * self.bond.L

    @property
    def bending(self) -> float:
        """EI in N m²."""
        return self.bond.bending * self.bond.L

    def euler(self, load: float) -> float:
        """Return the tip's deflection under a small load P across a beam stiff in shear: P L³/(3 EI), in m."""
        return load * self.length**3 / (3.0 * self.bending)

    def timoshenko(self, load: float, kappa: float = 1.0) -> float:
        """Return the same of a beam with the shear coefficient κ: P L³/(3 EI) + P L/(κ GA), in m."""
        return self.euler(load) + load * self.length / (kappa * self.bond.shear * self.bond.L)

    def slope(self, load: float) -> float:
        """Return what both turn by at the tip: P L²/(2 EI), in rad."""
        return 0.5 * load * self.length**2 / self.bending

    def deflection(self, load: float) -> float:
        """Return the same of the row of n bonds: P L³/(3 EI) (1 − 1/(4 n²)) + P L/(GA).

        Bond k turns its end against its beginning by the moment in its middle, P (n − k − ½) l, times l/EI, and slants
        by the mean of both turns plus P/(GA); the sum over all bonds is the trapezoidal rule for the beam's integral.
        """
        bent = self.euler(load) * (1.0 - 0.25 / self.n**2)
        return bent + load * self.length / (self.bond.shear * self.bond.L)

    def bending_modes(self, mass: float, inertia: float) -> tuple[Floats, Floats]:
        """Return the frequencies of small bending vibrations, and their shapes.

        Parameters
        ----------
        mass, inertia : float
            Of each sphere, in kg and kg m².

        Returns
        -------
        frequency : (2 n,) float64
            In rad/s, the lowest first.
        shape : (2 n, 2 n) float64
            One mode a column: deflections in m of the spheres 1 to n, then their slopes in rad.
        """
        from scipy.linalg import eigh

        n = self.n
        shear, bending = np.zeros((n, 2 * (n + 1))), np.zeros((n, 2 * (n + 1)))
        for k in range(n):
            shear[k, [k, k + 1]] = -1.0, 1.0
            shear[k, [n + 1 + k, n + 2 + k]] = -0.5 * self.bond.L
            bending[k, [n + 1 + k, n + 2 + k]] = -1.0, 1.0
        stiffness = self.bond.shear * shear.T @ shear + self.bond.bending * bending.T @ bending
        free = [*range(1, n + 1), *range(n + 2, 2 * n + 2)]
        inert = np.diag([mass] * n + [inertia] * n)
        square, shape = eigh(stiffness[np.ix_(free, free)], inert)
        return np.sqrt(square), shape
