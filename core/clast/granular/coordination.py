"""Coordination number: with how many others a grain is in contact."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.maths.box import Box
from clast.scene.bonding import close_pairs

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
TOLERANCE = 0.01
"""Gap up to which two primaries touch, as a share of the mean primary diameter."""


def touching_bodies(
    position: Floats, radius: Floats, body: Ints, tolerance: float = TOLERANCE, box: Box | None = None
) -> Ints:
    """Return the pairs of bodies of which at least one primary of each touch.

    Parameters
    ----------
    position : (n, 3) float64
        Centres in m; particles with NaN positions touch nothing.
    radius : (n,) float64
        In m.
    body : (n,) int64
        The grain, or the fragment, of each primary; −1 for none.
    tolerance : float
        Primaries touch where the gap of their surfaces is at most this share of the mean primary diameter.
    box : Box, optional
        Where it repeats itself, bodies touch across its faces too.

    Returns
    -------
    (c, 2) int64
        Each pair once, the lower number first.

    Examples
    --------
    >>> row = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [4.01, 0.0, 0.0], [7.0, 0.0, 0.0]])
    >>> touching_bodies(row, np.ones(4), np.array([0, 0, 1, 2])).tolist()
    [[0, 1]]
    """
    counted = np.flatnonzero(np.isfinite(position[:, 0]) & (body >= 0))
    if not len(counted):
        return np.zeros((0, 2), np.int64)
    reach = tolerance * 2.0 * float(radius[counted].mean())
    ends, _ = close_pairs(position[counted], radius[counted], reach, box)
    pairs = np.sort(body[counted][ends], axis=1)
    return np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0).reshape(-1, 2)


def coordination_numbers(pairs: Ints, count: int) -> Ints:
    """Return with how many others each of ``count`` bodies is in contact, (count,)."""
    return np.bincount(pairs.ravel(), minlength=count)
