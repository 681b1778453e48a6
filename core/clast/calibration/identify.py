"""Identifiability: how surely the targets fix the parameters, and which of them they cannot tell apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
LOOSE = 0.25
"""Standard deviation, as a share of its range, from which on a parameter counts as not determined."""

TOGETHER = 0.3
"""Share in a loose direction from which on a parameter belongs to it."""


@dataclass(frozen=True)
class Identified:
    """What the targets say of the parameters at the optimum.

    Attributes
    ----------
    deviation : (d,) float64
        Standard deviation of each parameter as a share of its range, the range itself being the prior knowledge.
    loose : list of list of int
        Sets of parameters that can change together without the targets noticing; a set of one is a parameter that
        does nothing.
    """

    deviation: Floats
    loose: list[list[int]]


def identify(slopes: Floats, noise: Floats) -> Identified:
    """Return how well parameters are determined, from the Fisher information of the targets.

    Parameters
    ----------
    slopes : (goals, d) float64
        Of the residuals over the range of each parameter.
    noise : (goals,) float64
        Standard error of the residuals: of repeats, and at least 1, the tolerance that was asked for.
    """
    dimensions = slopes.shape[1]
    prior = 12.0 * np.eye(dimensions)  # that of a uniform distribution over the range
    information = (slopes / noise[:, None]).T @ (slopes / noise[:, None])
    deviation = np.sqrt(np.diag(np.linalg.inv(information + prior)))
    values, directions = np.linalg.eigh(information)
    loose = []
    for value, direction in zip(values, directions.T, strict=True):
        if value < 1.0 / LOOSE**2:
            members = [k for k in range(dimensions) if abs(direction[k]) > TOGETHER]
            if members not in loose:
                loose.append(members)
    return Identified(deviation, loose)
