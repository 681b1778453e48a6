"""The solitary wave of an uncompressed chain of equal Hertzian spheres.

With F = A δ^(3/2) between neighbours, A = 4/3 E* √R*, and bead masses m, a wave that keeps its shape and passes W
beads a second has the overlaps δ = (m W²/A)² φ(n − W t), the beads the peak speed v = (m/A)² W⁵ C: so W goes with
the fifth root of v whatever φ is. Nesterenko's long waves have φ = (5/4)² cos⁴(√10 x/5) over half a period, and C =
(5/4)². The discrete chain has the fixed point of φ = Λ * φ^(3/2), Λ the triangle of height 1 on −1 < x < 1, and C
the integral of φ^(3/2) over −½ < x < ½.

Source: V. F. Nesterenko (1983), doi:10.1007/BF00905892; the fixed point: J. M. English and R. L. Pego (2005),
Proc. Amer. Math. Soc. 133, 1763.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


class Wave(NamedTuple):
    """A wave without dimensions: overlap φ at places x, its largest value, and C."""

    x: Floats
    phi: Floats
    peak: float
    C: float

    def rate(self, speed: float, stiffness: float, mass: float) -> float:
        """Return W in beads per second, from the peak speed of beads in m/s, A in N m^(-3/2) and m in kg."""
        return float((speed / self.C) ** 0.2 * (stiffness / mass) ** 0.4)

    def overlap(self, rate: float, stiffness: float, mass: float) -> float:
        """Return the largest overlap in m of a wave that passes ``rate`` beads per second."""
        return float(self.peak * (mass * rate**2 / stiffness) ** 2)


def long_wave() -> Wave:
    """Return Nesterenko's wave, the limit of waves that are long against a bead; it spans five of them."""
    half = 0.25 * np.pi * np.sqrt(10.0)
    x = np.linspace(-half, half, 401)
    return Wave(x, (5 / 4) ** 2 * np.cos(np.sqrt(10.0) / 5 * x) ** 4, (5 / 4) ** 2, (5 / 4) ** 2)


@cache
def discrete_wave(per_bead: int = 200, reach: int = 6) -> Wave:
    """Return the wave of the discrete chain, by a fixed-point iteration that keeps the size.

    Parameters
    ----------
    per_bead : int
        Points per bead, an even number.
    reach : int
        Beads on each side.

    Examples
    --------
    The long wave has 1.5625 for both:

    >>> wave = discrete_wave()
    >>> round(wave.peak, 4), round(wave.C, 4)
    (1.4874, 1.6249)
    """
    h = 1.0 / per_bead
    x = h * np.arange(-reach * per_bead, reach * per_bead + 1)
    triangle = h * (1.0 - np.abs(h * np.arange(-per_bead, per_bead + 1)))
    phi = np.maximum(1.0 - np.abs(x) / 2.0, 0.0)
    for _ in range(60):
        image = np.convolve(phi**1.5, triangle, mode="same")
        # of the multiples of a fixed point the iteration flees all but the one that it is scaled to
        phi = image * (np.sum(phi * phi) / np.sum(phi * image)) ** 3
    inside = np.abs(x) <= 0.5 + 0.5 * h
    return Wave(np.asarray(x), phi, float(phi.max()), float(np.trapezoid(phi[inside] ** 1.5, dx=h)))
