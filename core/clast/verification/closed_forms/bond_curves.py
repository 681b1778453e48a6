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


@dataclass(frozen=True)
class Softening:
    """A cohesive bond: linear softening by opening and sliding, root mean squares over the section.

    Source: P. P. Camanho, C. G. Dávila (2002), NASA/TM-2002-211737, with the criterion of the energies linear.

    Attributes
    ----------
    normal, shear : float
        E and G in Pa.
    strength, shear_strength : float
        In Pa.
    energy, shear_energy : float
        Energies of fracture in J/m².

    Examples
    --------
    A bond of 1 m that is pulled holds half of its strength half-way between first damage and end:

    >>> bond = Softening(normal=1.0, shear=1.0, strength=0.1, shear_strength=0.1, energy=0.1, shear_energy=0.1)
    >>> pulled = Course(length=1.0, radius=1.0, stretching=1.0, sliding=0.0, twisting=0.0, bending=0.0)
    >>> round(float(bond.left(pulled, 1.05)) * 1.05, 12), float(bond.reached(pulled, 2.0))
    (0.05, 1.0)
    """

    normal: float
    shear: float
    strength: float
    shear_strength: float
    energy: float
    shear_energy: float

    def left(self, course: Course, t: Times) -> Any:
        """Return the share of the stiffness that is left, 1 − D, at the times of a growing strain."""
        by_stress, end = self._measures(course, t)
        beyond = np.maximum(by_stress, 1.0)
        return 1.0 - np.minimum(end * (beyond - 1.0) / (beyond * (end - 1.0)), 1.0)

    def reached(self, course: Course, t: Times) -> Any:
        """Return the strain as a share of that at which nothing is left."""
        by_stress, end = self._measures(course, t)
        return by_stress / end

    def spent(self, course: Course, t: Times) -> Any:
        """Return the energy in J/m² that breaking takes in the proportion of opening to sliding at a time."""
        opening, sliding = self._shares(course, t)
        return (opening * self.energy + sliding * self.shear_energy) / (opening + sliding)

    def _shares(self, course: Course, t: Times) -> tuple[Any, Any]:
        a, b = _separations(course, t)
        return self.normal * course.length * a / self.energy, self.shear * course.length * b / self.shear_energy

    def _measures(self, course: Course, t: Times) -> tuple[Any, Any]:
        a, b = _separations(course, t)
        square = a * (self.normal / self.strength) ** 2 + b * (self.shear / self.shear_strength) ** 2
        opening, sliding = self._shares(course, t)
        return np.sqrt(square), 2.0 * square / (opening + sliding)


def _separations(course: Course, t: Times) -> tuple[Any, Any]:
    """Return the squares of the strains by opening and by sliding, means over the section."""
    opened = np.maximum(course.axial(t), 0.0) ** 2 + 0.25 * course.bent(t) ** 2
    return opened, course.shear(t) ** 2 + 0.5 * course.twisted(t) ** 2
