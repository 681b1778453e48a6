"""Closed form of an impact with a piecewise linear hysteretic force.

Source: the force of S. Luding (2008), doi:10.1007/s10035-008-0099-x, Eqs. 4–6, integrated over an impact.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt


@dataclass(frozen=True)
class PlasticImpact:
    """A sphere that falls on a plane without dashpots.

    Attributes
    ----------
    loading, unloading, cohesion : float
        k_1, k_p and k_c in N/m.
    depth : float
        Overlap at which unloading reaches k_p, in m.
    mass, speed : float
        In kg and m/s.

    Examples
    --------
    Without cohesion the restitution is √(k_1/k_2), with k_2 half-way to k_p at half the depth:

    >>> impact = PlasticImpact(1.0, 4.0, 0.0, depth=2.0, mass=1.0, speed=1.0)
    >>> round(impact.deepest, 6), round(impact.restitution**2, 6)
    (1.0, 0.4)
    """

    loading: float
    unloading: float
    cohesion: float
    depth: float
    mass: float
    speed: float

    @property
    def energy(self) -> float:
        """Kinetic energy before the impact in J."""
        return 0.5 * self.mass * self.speed**2

    @property
    def beyond(self) -> float:
        """Energy that is left when the contact is pressed to ``depth``, in J; below 0 where it never is."""
        return self.energy - 0.5 * self.loading * self.depth**2

    @property
    def deepest(self) -> float:
        """Largest overlap in m."""
        if self.beyond <= 0.0:
            return self.speed * sqrt(self.mass / self.loading)
        stretch = self.loading / self.unloading * self.depth
        return self.lasting + sqrt(stretch**2 + 2.0 * self.beyond / self.unloading)

    @property
    def stiffness(self) -> float:
        """k_2 of the rebound in N/m."""
        share = min(self.deepest / self.depth, 1.0)
        return self.loading + (self.unloading - self.loading) * share

    @property
    def lasting(self) -> float:
        """Overlap in m at which the rebound's force passes through zero."""
        if self.beyond > 0.0:
            return (1.0 - self.loading / self.unloading) * self.depth
        return (1.0 - self.loading / self.stiffness) * self.deepest

    @property
    def restitution(self) -> float:
        """v'/v; 0 where the sphere stays."""
        lasting, k_2 = self.lasting, self.stiffness
        released = 0.5 * k_2 * (self.deepest - lasting) ** 2
        pulled = 0.5 * self.cohesion * lasting**2 * k_2 / (k_2 + self.cohesion)
        return sqrt(max(released - pulled, 0.0) / self.energy)
