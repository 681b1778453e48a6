"""Closed forms of a bond whose ends move as prescribed: its strains, its stresses, and when it breaks.

Source: Rotter, Dosta and Düster (2023), Eqs. 7–13 and Fig. 5, doi:10.1007/s40571-023-00610-0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Times = Any
"""One time in s, or an array of them."""


@dataclass(frozen=True)
class Course:
    """How the ends of one bond move: at constant velocities, and spinning against each other.

    Attributes
    ----------
    length, radius : float
        L0 and R in m.
    stretching, sliding : float
        Velocity of end j against end i along the bond and across it, in m/s.
    twisting, bending : float
        Spin of end j less that of end i, about the bond and across it, in rad/s; each end has half of it.
    """

    length: float
    radius: float
    stretching: float
    sliding: float
    twisting: float
    bending: float

    def distance(self, t: Times) -> Any:
        """Return |d| in m."""
        return np.hypot(self.length + self.stretching * t, self.sliding * t)

    def axial(self, t: Times) -> Any:
        """Return the strain (|d| − L0)/L0."""
        return self.distance(t) / self.length - 1.0

    def shear(self, t: Times) -> Any:
        """Return the strain across the bond, the sine of its slant."""
        return self.sliding * t / self.distance(t)

    def bent(self, t: Times) -> Any:
        """Return the strain of the outermost fibre by bending, Rθ/L0."""
        return self.radius * self.bending * t / self.length

    def twisted(self, t: Times) -> Any:
        """Return the shear strain of the outermost fibre by twisting, Rθ/L0."""
        return self.radius * self.twisting * t / self.length


def plastic(strain: Floats) -> Floats:
    """Return stress over yield stress of Model 2, for a growing strain in units of the yield strain.

    >>> plastic(np.array([0.5, 1.0, 3.0])).tolist()
    [0.5, 1.0, 1.0]
    """
    return np.minimum(strain, 1.0)


def cracking(strain: Floats, shares: Floats) -> Floats:
    """Return stress over yield stress of Model 3, for a growing strain in units of the yield strain.

    The stress drops to ``shares[k]`` when it reaches the yield stress for the (k + 1)th time, and grows elastically in
    between.

    >>> cracking(np.array([0.5, 1.1, 1.7, 1.9]), np.array([0.4, 0.2])).round(9).tolist()
    [0.5, 0.5, 0.3, 0.5]
    """
    lost = np.concatenate([[0.0], np.cumsum(1.0 - shares)])
    drops = np.searchsorted(1.0 + lost[:-1], strain)
    return np.asarray(strain - lost[drops])
