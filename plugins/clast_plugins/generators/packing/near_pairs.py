"""How many spheres of a random packing lie near each other, told without packing.

In a random pattern of points, a sphere of diameter 1 at packing fraction φ has 8 φ (1 + g)³ others within a gap g.
Pushing overlapping spheres apart moves the nearest ones to where they just touch and thins out the shell behind them:
``FACTOR`` is what then becomes of that number in the bulk. At the surface of the body there are no others outside,
which takes a share proportional to the surface per volume.

The numbers were fitted to 260 packings made by :func:`relax`, of 5 to 4600 spheres in whole and flattened balls, φ from
0.09 to 0.65: of 2600 counts, 99 % lie within the band told. Spheres that all but touch are another matter: how many do
depends on how far a packing was settled, so nothing is told for gaps below a twentieth of a diameter.

Spheres of scattered sizes have about as many near pairs as equal ones of their mean diameter: 36 packings of deviations
from 0.1 to 0.3 of it, normal and lognormal, 150 and 600 spheres, gaps from 0.1 to 0.9, keep to the wider band told.
"""

from __future__ import annotations

import math

import numpy as np

from clast.parts.generator import Estimate, Gaps

FRACTIONS = (0.1, 0.35, 0.6)
GAPS = (0.05, 0.2, 0.5, 0.75, 1.0)
FACTOR = (
    (0.71, 1.16, 1.14, 1.16, 1.18),
    (1.12, 1.15, 1.07, 1.06, 1.14),
    (1.30, 1.14, 0.85, 0.89, 1.06),
)
"""By packing fraction (rows) and gap in diameters (columns)."""
SURFACE, SURFACE_PER_GAP = 0.44, 1.42
BAND = 0.04
"""Where the rule itself is right to, as a share; the scatter of the count comes on top."""
WIDER = 0.4
"""What a deviation of the diameters, as a share of their mean, adds to the band."""


def near_pairs(count: int, volume: float, surface: float, gaps: Gaps) -> Estimate | None:
    """Return about how many pairs of a packing have a gap within bounds.

    Parameters
    ----------
    count : int
        Number of spheres.
    volume, surface : float
        Of the body they fill, in diameters³ and diameters².
    gaps : Gaps
        In diameters.

    Returns
    -------
    Estimate or None
        None where the rule does not reach: a bound of the gap between 0 and 0.05, or above 1.

    Examples
    --------
    361 primaries of 0.25 mm in 2.16 mm with bonds up to half a primary long; packings have 2131 ± 15:

    >>> D = 2.16 / 0.25
    >>> told = near_pairs(361, math.pi / 6 * D**3, math.pi * D**2, Gaps(-math.inf, 0.5))
    >>> round(told.value), round(told.band, 2)
    (2094, 0.08)
    """
    if not GAPS[0] <= gaps.most <= GAPS[-1] or 0.0 < gaps.least < GAPS[0]:
        return None
    pairs = _up_to(count, volume, surface, gaps.most)
    if gaps.least > 0.0:
        pairs -= _up_to(count, volume, surface, gaps.least)
    return Estimate(pairs, BAND + 2.0 / math.sqrt(max(pairs, 1.0)))


def gaps_between(gaps: Gaps, mean: float, deviation: float) -> Gaps:
    """Return the bounds in mean diameters, in m, where the diameters scatter by a share.

    The smaller of two has a diameter of (1 − deviation/√π) on average, for any sizes with a normal distribution.

    >>> gaps_between(Gaps(0.0, 0.5, relative=True), 1.0, 0.0)
    Gaps(least=0.0, most=0.5, relative=True)
    """
    per_mean = gaps.per(mean)
    smaller = 1.0 - deviation / math.sqrt(math.pi)
    return per_mean._replace(most=per_mean.most * smaller) if gaps.relative else per_mean


def scattered(pairs: Estimate | None, deviation: float) -> Estimate | None:
    """Return how many pairs of scattered sizes are near, from how many of equal spheres of their mean diameter are.

    >>> scattered(Estimate(100.0, 0.1), 0.25)
    Estimate(value=100.0, band=0.2)
    """
    return None if pairs is None else Estimate(pairs.value, pairs.band + WIDER * deviation)


def share_of_bulk(gap: float, volume: float, surface: float) -> float:
    """Return how many others a sphere of a body has within a gap on average, as a share of those in its middle."""
    return 1.0 - (SURFACE + SURFACE_PER_GAP * gap) * surface / (6.0 * volume)


def _up_to(count: int, volume: float, surface: float, gap: float) -> float:
    fraction = count * math.pi / 6.0 / volume
    factor = float(np.interp(fraction, FRACTIONS, [np.interp(gap, GAPS, row) for row in FACTOR]))
    neighbours = 8.0 * fraction * (1.0 + gap) ** 3 * factor * share_of_bulk(gap, volume, surface)
    return 0.5 * count * min(neighbours, count - 1.0)
