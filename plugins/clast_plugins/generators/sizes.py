"""Sizes of grains and primaries: evenly spaced quantiles of a distribution."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.maths.distributions import lognormal

Floats = NDArray[np.float64]
FARTHEST = 3.0
"""Where the distribution is cut, in deviations from the mean, unless bounds are given."""


def sizes(count: int, mean: float, deviation: float, bounds: tuple[float, float] | None = None) -> Floats:
    """Return ``count`` diameters in rising order: the middles of equally probable parts of a normal distribution.

    Quantiles, and no random numbers: mean and deviation of a few grains are then those asked for.

    Parameters
    ----------
    count : int
    mean, deviation : float
        Of the normal distribution, in m.
    bounds : (least, most), optional
        Where it is cut, in m; by default three deviations from the mean.

    Examples
    --------
    >>> sizes(3, 2.0, 0.0).tolist()
    [2.0, 2.0, 2.0]
    >>> [round(d, 3) for d in sizes(3, 2.0, 0.5).tolist()]
    [1.518, 2.0, 2.482]
    """
    if deviation == 0.0:
        return np.full(count, mean)
    from scipy.special import ndtr, ndtri

    least, most = bounds if bounds is not None else (mean - FARTHEST * deviation, mean + FARTHEST * deviation)
    low, high = ndtr((np.array([least, most]) - mean) / deviation)
    share = low + (high - low) * (np.arange(count) + 0.5) / count
    return np.asarray(mean + deviation * ndtri(share))


def lognormal_sizes(count: int, deviation: float) -> Floats:
    """Return ``count`` diameters in rising order, of mean 1: the middles of equally probable parts.

    The logarithms have a normal distribution, cut at three deviations.

    Parameters
    ----------
    count : int
    deviation : float
        Standard deviation of the diameters, above zero, before the distribution is cut.

    Examples
    --------
    >>> [round(d, 3) for d in lognormal_sizes(3, 0.5).tolist()]
    [0.567, 0.894, 1.41]
    """
    from scipy.special import ndtr

    low, high = ndtr(np.array([-FARTHEST, FARTHEST]))
    return lognormal(low + (high - low) * (np.arange(count) + 0.5) / count, deviation)


def mean_cube(mean: float, deviation: float, bounds: tuple[float, float] | None = None) -> float:
    """Return the mean of (D/mean)³ over the distribution of :func:`sizes`.

    >>> round(mean_cube(2.0, 0.0), 6)
    1.0
    """
    return float(((sizes(4096, mean, deviation, bounds) / mean) ** 3).mean())
