"""Surrogate: a Gaussian process for every goal, fitted to noisy points."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.calibration.responses import Goal, Response
from clast.errors import ConfigError

Floats = NDArray[np.float64]
LEAST_NOISE = 1e-3
"""Smallest standard error, as a share of a goal's scale: two runs never differ by less than rounding does."""


@dataclass(frozen=True)
class Surrogate:
    """What all goals are expected to be, at any point of the unit cube.

    Attributes
    ----------
    processes : list
        One fitted ``GaussianProcessRegressor`` a goal, of (response - value)/scale.
    """

    processes: Sequence[Any]

    def predict(self, x: Floats) -> tuple[Floats, Floats]:
        """Return means and deviations of all goals' residuals at (n, d) points: (n, goals) each."""
        told = [process.predict(x, return_std=True) for process in self.processes]
        return np.column_stack([mean for mean, _ in told]), np.column_stack([sd for _, sd in told])

    def slopes(self, x: Floats, step: float = 0.02) -> Floats:
        """Return the slopes of all residuals at one point over the whole range of each parameter: (goals, d)."""
        columns = []
        for axis in range(len(x)):
            ends = np.array([x, x])
            ends[0, axis], ends[1, axis] = max(0.0, x[axis] - step), min(1.0, x[axis] + step)
            low, high = self.predict(ends)[0]
            columns.append((high - low) / (ends[1, axis] - ends[0, axis]))
        return np.column_stack(columns)


def fit(points: Floats, responses: Sequence[Sequence[Response]], goals: Sequence[Goal]) -> Surrogate:
    """Fit one process a goal: a constant, a linear trend and a smooth rest, with the noise that repeats show.

    Parameters
    ----------
    points : (n, d) float64
        In the unit cube.
    responses : n sequences
        One response a goal.

    Raises
    ------
    ConfigError
        If scikit-learn is not installed, or too few points have a response.
    """
    try:
        from sklearn.exceptions import ConvergenceWarning
        from sklearn.gaussian_process import GaussianProcessRegressor
        from sklearn.gaussian_process.kernels import RBF, ConstantKernel, DotProduct
    except ImportError:
        raise ConfigError("clast calibrate needs scikit-learn: pip install 'clast[calibrate]'") from None
    processes = []
    for k, goal in enumerate(goals):
        told = np.array([(each[k].value, each[k].error) for each in responses])
        known = np.isfinite(told).all(axis=1)
        if known.sum() < 3:
            raise ConfigError(
                f"only {known.sum()} points have a result for {goal.name}; see why runs failed in runs.csv"
            )
        residual, noise = (told[known, 0] - goal.value) / goal.scale, told[known, 1] / goal.scale
        pooled = max(float(np.sqrt(np.mean(noise**2))), LEAST_NOISE)  # one point's few repeats tell little of its own
        spread = max(float(residual.std()), 0.1)
        size = ConstantKernel(spread**2, (1e-2 * spread**2, 1e3 * spread**2))
        kernel = size * RBF(np.full(points.shape[1], 0.5), (0.1, 20.0)) + size * DotProduct(1.0, (1e-2, 1e2))
        process = GaussianProcessRegressor(kernel, alpha=pooled**2, n_restarts_optimizer=2, random_state=0)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)  # a length at its bound: a parameter that does nothing
            process.fit(points[known], residual)
        processes.append(process)
    return Surrogate(processes)
