"""Closed forms of an impact of spheres with linear springs and dashpots.

Source: J. Schäfer, S. Dippel and D. E. Wolf (1996), doi:10.1051/jp1:1996129, Sects. 2 and 3.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, exp, log, pi, sqrt


@dataclass(frozen=True)
class LinearImpact:
    """A spring k and a dashpot between a mass and a plane.

    Attributes
    ----------
    stiffness : float
        k in N/m.
    mass : float
        Effective mass m in kg.
    restitution : float
        e > 0; the dashpot's ratio is β = −ln e/√(π² + ln² e).

    Examples
    --------
    >>> found = LinearImpact(stiffness=1e4, mass=1.0, restitution=0.5)
    >>> round(found.duration, 6), round(found.rebound, 6)
    (0.032172, 0.5)
    """

    stiffness: float
    mass: float
    restitution: float = 1.0

    @property
    def ratio(self) -> float:
        """Damping ratio β."""
        ln_e = log(self.restitution)
        return -ln_e / sqrt(pi**2 + ln_e**2)

    @property
    def duration(self) -> float:
        """π/ω in s, ω = √(k/m (1 − β²))."""
        return pi / sqrt(self.stiffness / self.mass * (1.0 - self.ratio**2))

    @property
    def rebound(self) -> float:
        """exp(−β √(k/m) π/ω): the speed after the impact over that before it."""
        return exp(-self.ratio * sqrt(self.stiffness / self.mass) * self.duration)


def slip_ratio(stiffness_ratio: float) -> float:
    """Return slip' over slip of a sphere whose contact point sticks on a plane all through an elastic impact.

    Across, the contact point vibrates with 2/7 of the mass: cos(π √(7/2 k_t/k_n)).

    >>> round(slip_ratio(2.0 / 7.0), 6)
    -1.0
    """
    return cos(pi * sqrt(3.5 * stiffness_ratio))
