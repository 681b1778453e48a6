"""Random factors of mean 1, made from uniform random numbers.

Source: W. Weibull, "A statistical distribution function of wide applicability", Journal of Applied Mechanics 18 (1951)
293-297, doi:10.1115/1.4010337.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def weibull(u: Floats, modulus: float) -> Floats:
    """Return factors of mean 1 with the distribution of Weibull.

    Equation: x = (−ln(1 − u))^(1/m) / Γ(1 + 1/m), so that P(X ≤ x) = 1 − exp(−(Γ(1 + 1/m) x)^m).

    Parameters
    ----------
    u : (n,) float64
        Uniform random numbers between 0 and 1.
    modulus : float
        Weibull modulus m, above zero.

    Returns
    -------
    (n,) float64
        Each grows with its ``u``.

    Examples
    --------
    With m = 1 it is the exponential distribution, whose median is ln 2:

    >>> round(float(weibull(np.array([0.5]), 1.0)[0]), 6)
    0.693147
    """
    return np.asarray((-np.log1p(-u)) ** (1.0 / modulus) / math.gamma(1.0 + 1.0 / modulus), np.float64)


def weibull_deviation(modulus: float) -> float:
    """Return the standard deviation of :func:`weibull`: √(Γ(1 + 2/m)/Γ(1 + 1/m)² − 1).

    >>> weibull_deviation(1.0), round(weibull_deviation(5.0), 3)
    (1.0, 0.229)
    """
    ratio = math.gamma(1.0 + 2.0 / modulus) / math.gamma(1.0 + 1.0 / modulus) ** 2
    return math.sqrt(ratio - 1.0)


def lognormal(u: Floats, deviation: float) -> Floats:
    """Return factors of mean 1 whose logarithms are normally distributed.

    Equation: x = exp(s z − s²/2) with s² = ln(1 + deviation²), where z has the normal distribution of mean 0 and
    deviation 1.

    Parameters
    ----------
    u : (n,) float64
        Uniform random numbers between 0 and 1.
    deviation : float
        Standard deviation of the factors, above zero.

    Returns
    -------
    (n,) float64
        Each grows with its ``u``.

    Examples
    --------
    >>> round(float(lognormal(np.array([0.5]), 0.75)[0]), 6)
    0.8
    """
    from scipy.special import ndtri

    square = math.log1p(deviation**2)
    return np.asarray(np.exp(math.sqrt(square) * ndtri(u) - 0.5 * square), np.float64)
