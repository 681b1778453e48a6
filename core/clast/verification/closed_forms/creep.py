"""Closed form of a Kelvin–Voigt bond between two bodies under a load that stays: a damped oscillator, pushed.

Source: the step response of a damped oscillator; without inertia the creep of a Kelvin body, W. N. Findley, J. S. Lai,
K. Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials, North-Holland (1976), Chapter 5.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Creep:
    """How the measure e of a bond grows from rest: m d²e/dt² + k (τ de/dt + e) = F.

    Attributes
    ----------
    stiffness : float
        k in N/m, or N m/rad.
    inertia : float
        Reduced mass of both ends in kg, or reduced moment of inertia in kg m².
    retardation : float
        τ in s.
    load : float
        F in N, or N m.

    Examples
    --------
    Without inertia to speak of, 63 % of the elastic strain are reached after τ:

    >>> creep = Creep(stiffness=10.0, inertia=1e-9, retardation=1.0, load=10.0)
    >>> round(float(creep.strain(1.0)), 3)
    0.632
    """

    stiffness: float
    inertia: float
    retardation: float
    load: float

    def strain(self, t: Any) -> Any:
        """Return e in m, or rad, at one time or an array of times."""
        square = self.stiffness / self.inertia
        decay = 0.5 * self.retardation * square
        root = np.sqrt(complex(decay * decay - square))
        slow, fast = np.exp((root - decay) * t), np.exp(-(root + decay) * t)
        left = 0.5 * (slow + fast) + 0.5 * decay / root * (slow - fast)
        return self.load / self.stiffness * (1.0 - np.real(left))
