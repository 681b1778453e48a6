"""Breakage measures: how far a grading has moved, as one number."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from clast.granular.grading import Grading

Floats = NDArray[np.float64]
SILT = 74e-6
"""Size in m below which crushing does not count for Hardin."""
FRACTAL = 2.6
"""Dimension of the ultimate grading after Einav."""


def hardin(before: Grading, after: Grading) -> float:
    """Return Hardin's relative breakage B_r.

    Equation: B_r = B_t/B_p. The breakage potential B_p = ∫ log₁₀(D/0.074 mm) df over the mass shares f of the grading
    before, sizes below 0.074 mm (the largest silt) counting 0; the total breakage B_t is by how much this integral is
    less after.

    0 where nothing broke, 1 where all is silt. Grains whose primaries are of the size d cannot come above
    1 − log(d/0.074 mm)/log(D/0.074 mm); NaN where all was silt before.

    Source: B. O. Hardin, Crushing of soil particles, Journal of Geotechnical Engineering 111 (1985), 1177-1192,
    doi:10.1061/(ASCE)0733-9410(1985)111:10(1177).

    Examples
    --------
    Of grains of 7.4 mm a half breaks to 0.74 mm: the potential falls from 2 to 1.5.

    >>> whole = Grading(np.array([7.4e-3]), np.array([1.0]))
    >>> round(hardin(whole, Grading(np.array([0.74e-3, 7.4e-3]), np.array([0.5, 0.5]))), 12)
    0.25
    """
    first = _potential(before)
    return (first - _potential(after)) / first if first > 0.0 else math.nan


def _potential(grading: Grading) -> float:
    return float(grading.share @ np.maximum(np.log10(grading.size / SILT), 0.0))


def einav(before: Grading, after: Grading, smallest: float, dimension: float = FRACTAL) -> float:
    """Return Einav's breakage index B.

    Equation: B = ∫ (F − F₀) d ln D / ∫ (F_u − F₀) d ln D, areas between cumulative gradings by mass: F₀ before, F now,
    F_u = (D^β − d^β)/(D_M^β − d^β) with β = 3 − dimension at last. D_M is the largest size before and d the smallest
    that can come out.

    0 where nothing broke, 1 where the grading is the ultimate one. A model whose primaries do not break can come above
    1: if all falls to primaries, the grading is finer than the fractal one. NaN where the grading before is as fine
    as the ultimate one, so that nothing can break.

    Parameters
    ----------
    before, after : Grading
        By mass.
    smallest : float
        d in m, above 0: the diameter of a primary.
    dimension : float
        Fractal dimension α of the ultimate grading, below 3; 2.5 to 2.7 is usual.

    Source: I. Einav, Breakage mechanics, Part I: Theory, Journal of the Mechanics and Physics of Solids 55 (2007),
    1274-1297, doi:10.1016/j.jmps.2006.11.003.

    Examples
    --------
    Areas are differences of mean logarithms. With very small last sizes the mean logarithm of the ultimate grading is
    1/β = 2.5 below that of D_M; a fall of all the mass by one e-fold is 0.4 of that:

    >>> whole, less = Grading(np.array([1e-3]), np.array([1.0])), Grading(np.array([1e-3 / math.e]), np.array([1.0]))
    >>> round(einav(whole, less, 1e-30), 6)
    0.4
    """
    potential = before.mean_log - ultimate_mean_log(float(before.size[-1]), smallest, dimension)
    return (before.mean_log - after.mean_log) / potential if potential > 0.0 else math.nan


def ultimate_mean_log(largest: float, smallest: float, dimension: float = FRACTAL) -> float:
    """Return the mean of ln(D in m) over the mass of the fractal grading between two sizes in m."""
    beta = 3.0 - dimension
    ratio = math.pow(smallest / largest, beta)
    if ratio >= 1.0:
        return math.log(largest)
    return math.log(largest) - 1.0 / beta - ratio * math.log(smallest / largest) / (1.0 - ratio)


def ultimate_finer(size: Floats, largest: float, smallest: float, dimension: float = FRACTAL) -> Floats:
    """Return the share of the mass that is finer than sizes in m in the fractal grading between two sizes."""
    beta = 3.0 - dimension
    return np.asarray(np.clip((size**beta - smallest**beta) / (largest**beta - smallest**beta), 0.0, 1.0))
