"""Closed forms of elastic spheres that stick.

Sources: pull-off by K. L. Johnson, K. Kendall, A. D. Roberts (1971), doi:10.1098/rspa.1971.0141; end of the neck and
sticking by C. Thornton, Z. Ning (1998), doi:10.1016/S0032-5910(98)00099-0.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt


@dataclass(frozen=True)
class StickySpheres:
    """Two spheres that stick, or a sphere and a plane.

    Attributes
    ----------
    modulus, radius : float
        E* in Pa and R* in m.
    adhesion : float
        Work of adhesion w in J/m².
    mass : float
        m* in kg.

    Examples
    --------
    A sphere of radius 1 mm on a plane:

    >>> spheres = StickySpheres(1e6, 1e-3, 0.1, 4e-6)
    >>> round(spheres.pull_off, 7), round(spheres.distance, 9), round(spheres.sticking_speed, 3)
    (0.0004712, 3.466e-06, 0.028)
    """

    modulus: float
    radius: float
    adhesion: float
    mass: float

    @property
    def pull_off(self) -> float:
        """Largest pull in N."""
        return 1.5 * pi * self.adhesion * self.radius

    @property
    def distance(self) -> float:
        """How far apart the undeformed bodies are as the neck snaps, in m, where the distance is driven."""
        return 0.75 * float(((pi * self.adhesion / self.modulus) ** 2 * self.radius) ** (1.0 / 3.0))

    @property
    def sticking_speed(self) -> float:
        """Speed in m/s below which elastic spheres stick."""
        force = self.adhesion**5 * self.radius**4 / self.modulus**2
        return sqrt(14.18 / self.mass) * sqrt(float(force ** (1.0 / 3.0)))

    def restitution(self, speed: float) -> float:
        """Return v'/v of an elastic impact; 0 where the spheres stick."""
        return sqrt(max(1.0 - (self.sticking_speed / speed) ** 2, 0.0))
