"""Proposal: where to look next, and which point is the best one known."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.calibration.surrogate import Surrogate
from clast.studies.design import quantiles

Floats = NDArray[np.float64]
CANDIDATES = 4096
DRAWS = 64


def misfit(residuals: Floats) -> Floats:
    """Return the mean square of residuals over all goals (the last axis): 1 where all are off by their scale."""
    return np.asarray(np.mean(residuals**2, axis=-1))


def candidates(dimensions: int, best: Floats, seed: int) -> Floats:
    """Return points of the unit cube to choose from: everywhere, and more of them around the best one."""
    everywhere = quantiles("sobol", CANDIDATES, dimensions, seed)
    random = np.random.default_rng(seed)
    near = [best + width * random.normal(size=(CANDIDATES // 4, dimensions)) for width in (0.2, 0.07, 0.02)]
    return np.asarray(np.clip(np.concatenate([everywhere, *near]), 0.0, 1.0))


def next_point(surrogate: Surrogate, known: Floats, seed: int) -> Floats:
    """Return the point of which most improvement is expected over what is known.

    The misfit is a sum of squares of Gaussian residuals; its improvement is averaged over draws of them (a composite
    acquisition: Astudillo and Frazier 2019, arXiv:1906.01537).
    """
    mean_known = misfit(surrogate.predict(known)[0])
    tried = candidates(known.shape[1], known[int(np.argmin(mean_known))], seed)
    mean, deviation = surrogate.predict(tried)
    draws = np.random.default_rng(seed).normal(size=(DRAWS, 1, mean.shape[1]))
    gained = np.maximum(mean_known.min() - misfit(mean + deviation * draws), 0.0).mean(axis=0)
    if gained.max() <= 0.0:  # nothing better is in sight: make sure of the optimum
        return np.asarray(tried[int(np.argmin(misfit(mean)))])
    return np.asarray(tried[int(np.argmax(gained))])


def next_points(surrogate: Surrogate, known: Floats, count: int, seed: int) -> list[Floats]:
    """Return some points to run at the same time, each chosen as if those before it gave what is expected of them."""
    found: list[Floats] = []
    for k in range(count):
        found.append(next_point(surrogate, np.array([*known, *found]), seed + k))
        surrogate = surrogate.believing(found[-1])
    return found


def optimum(surrogate: Surrogate, known: Floats, seed: int) -> Floats:
    """Return the point where the surrogate expects the smallest misfit."""
    from scipy.optimize import minimize

    tried = candidates(known.shape[1], known[int(np.argmin(misfit(surrogate.predict(known)[0])))], seed)
    start = tried[int(np.argmin(misfit(surrogate.predict(tried)[0])))]

    def expected(x: Floats) -> float:
        return float(misfit(surrogate.predict(x[None])[0])[0])

    found = minimize(expected, start, method="L-BFGS-B", bounds=[(0.0, 1.0)] * known.shape[1])
    end = np.clip(found.x, 0.0, 1.0)
    return np.asarray(end if expected(end) <= expected(start) else start)
