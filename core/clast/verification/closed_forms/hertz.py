"""Closed forms of an elastic impact of Hertzian spheres.

Source: K. L. Johnson (1985), Contact Mechanics, Sect. 11.4. The duration's factor 2.9432… is exact: it is
4/5 B(2/5, 1/2).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import gamma, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.special import betainc

from clast.config.sections import Material

DURATION_FACTOR = 0.8 * gamma(0.4) * gamma(0.5) / gamma(0.9)


@dataclass(frozen=True)
class HertzImpact:
    """Two bodies that meet head-on.

    Attributes
    ----------
    modulus, radius, mass : float
        Effective ones: E* in Pa, R* in m, m* in kg.
    speed : float
        Approach in m/s.

    Examples
    --------
    Test 1 of Chung and Ooi (2011), limestone:

    >>> found = HertzImpact(modulus=1.0667e10, radius=5e-3, mass=5.236e-3, speed=20.0)
    >>> round(found.peak_force), f"{found.peak_overlap:.3e}", f"{found.duration:.3e}"
    (7108, '3.683e-04', '5.420e-05')
    """

    modulus: float
    radius: float
    mass: float
    speed: float

    @property
    def peak_overlap(self) -> float:
        """δ = (15 m* v²/(16 E* √R*))^(2/5) in m."""
        return float((15.0 * self.mass * self.speed**2 / (16.0 * self.modulus * sqrt(self.radius))) ** 0.4)

    @property
    def peak_force(self) -> float:
        """F = 4/3 E* √R* δ^(3/2) in N."""
        return float(4.0 / 3.0 * self.modulus * sqrt(self.radius) * self.peak_overlap**1.5)

    @property
    def duration(self) -> float:
        """t_c = 2.9432 δ/v in s."""
        return DURATION_FACTOR * self.peak_overlap / self.speed

    def course(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return times in units of the duration, and overlaps in units of the peak overlap, over one impact.

        With y = δ/δ_max the first half takes t/t_c = ½ I(y^(5/2); 2/5, 1/2), I the regularised incomplete beta
        function: the integral of dy/√(1 − y^(5/2)).
        """
        y = np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, 60)) ** 0.8
        t = 0.5 * betainc(0.4, 0.5, y**2.5)
        return np.concatenate([t, 1.0 - t[::-1]]), np.concatenate([y, y[::-1]])


def effective_modulus(a: Material, b: Material) -> float:
    """Return E* of two materials in Pa: 1/E* = (1 − ν_a²)/E_a + (1 − ν_b²)/E_b."""
    compliance = sum((1.0 - each.poisson_ratio**2) / each.young_modulus for each in (a, b))
    return 1.0 / compliance
