"""Grading: which share of the mass is finer than a size."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
SAME = 1e-9
"""Relative difference up to which two sizes are one: sums of equal volumes differ in their last digits."""


class Grading(NamedTuple):
    """A cumulative size distribution: a share of the mass, or of the number, up to each size.

    Attributes
    ----------
    size : (k,) float64
        Sizes that occur, rising, in m.
    share : (k,) float64
        Share of all that is of this size.
    """

    size: Floats
    share: Floats

    @property
    def finer(self) -> Floats:
        """Share up to and with each size, (k,); the last is 1."""
        return np.minimum(np.cumsum(self.share), 1.0)

    def quantile(self, share: float) -> float:
        """Return the smallest size with which at least this share is reached: 0.5 gives d50."""
        reached = np.cumsum(self.share) >= share * (1.0 - 1e-12)
        return float(self.size[np.argmax(reached)]) if reached.any() else float(self.size[-1])

    @property
    def mean_log(self) -> float:
        """Mean of ln(size in m)."""
        return float(self.share @ np.log(self.size))


def grading(size: Floats, mass: Floats) -> Grading:
    """Return the grading of bodies by their mass; equal masses give the distribution by number.

    Parameters
    ----------
    size, mass : (f,) float64
        Size in m and mass in any unit; at least one body.

    Examples
    --------
    One body of 2 mm and 3 kg, two of 1 mm and 0.5 kg:

    >>> found = grading(np.array([1e-3, 2e-3, 1e-3]), np.array([0.5, 3.0, 0.5]))
    >>> found.size.tolist(), found.finer.tolist(), found.quantile(0.2), found.quantile(0.5)
    ([0.001, 0.002], [0.25, 1.0], 0.001, 0.002)
    """
    order = np.argsort(size, kind="stable")
    rising, mass = size[order], mass[order]
    first = np.concatenate([[True], np.diff(rising) > SAME * rising[1:]])
    return Grading(rising[first], np.add.reduceat(mass, np.flatnonzero(first)) / mass.sum())
