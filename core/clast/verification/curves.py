"""Numbers read off curves that are known at points: tops, zeros, orders of convergence."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def peak(y: Floats) -> float:
    """Return the top of the parabola through the largest of some evenly spaced numbers and its neighbours.

    >>> round(peak(np.cos(np.linspace(-0.3, 0.4, 8))), 4)
    1.0
    """
    return top_of(y)[1]


def top_of(y: Floats) -> tuple[float, float]:
    """Return where :func:`peak` is, in places of the array, and how high.

    >>> x = np.arange(5.0)
    >>> top_of(2.0 - (x - 2.25) ** 2)
    (2.25, 2.0)
    """
    k = int(np.argmax(y))
    if k in (0, len(y) - 1):
        return float(k), float(y[k])
    before, top, after = (float(each) for each in y[k - 1 : k + 2])
    bend = before - 2.0 * top + after
    if not bend < 0.0:
        return float(k), top
    aside = 0.5 * (before - after) / bend
    return k + aside, top - 0.25 * (before - after) * aside


def zero(t: Floats, y: Floats) -> float:
    """Return when a curve last falls through zero, by a straight line between its points; nan if it never does.

    >>> zero(np.array([0.0, 1.0, 2.0]), np.array([2.0, 1.0, -1.0]))
    1.5
    """
    falls = np.nonzero((y[:-1] > 0.0) & (y[1:] <= 0.0))[0]
    if not len(falls):
        return float("nan")
    k = int(falls[-1])
    return float(t[k] + (t[k + 1] - t[k]) * y[k] / (y[k] - y[k + 1]))


def order(steps: Any, errors: Any) -> float:
    """Return p of errors ∝ steps^-p, by least squares in logarithms.

    >>> round(order([10, 20, 40], [1.0, 0.25, 0.0625]), 6)
    2.0
    """
    return -float(np.polyfit(np.log(np.asarray(steps, float)), np.log(np.asarray(errors, float)), 1)[0])


def crossings(t: Floats, y: Floats) -> Floats:
    """Return all times at which a curve passes through zero, by straight lines between its points.

    >>> crossings(np.array([0.0, 1.0, 2.0, 3.0]), np.array([1.0, -1.0, -1.0, 3.0])).tolist()
    [0.5, 2.25]
    """
    k = np.nonzero(y[:-1] * y[1:] < 0.0)[0]
    return np.asarray(t[k] + (t[k + 1] - t[k]) * y[k] / (y[k] - y[k + 1]))


def frequency(t: Floats, y: Floats) -> float:
    """Return the angular frequency of a vibration about zero in rad/s, from its first to its last passage; nan if none.

    >>> t = np.linspace(0.0, 10.0, 1001)
    >>> round(frequency(t, np.sin(3.0 * t + 0.2)), 4)
    3.0
    """
    times = crossings(t, y)
    return float(np.pi * (len(times) - 1) / (times[-1] - times[0])) if len(times) > 1 else float("nan")
