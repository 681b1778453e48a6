"""Surrogate: a Gaussian process for every goal, fitted to noisy points."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.calibration.config import LEAST_POINTS
from clast.calibration.responses import Goal, Response
from clast.errors import ConfigError

Floats = NDArray[np.float64]
LEAST_NOISE = 1e-3
"""Smallest standard error, as a share of the residuals: two runs never differ by less than rounding does."""

SMOOTH = (0.3, 20.0)
"""Lengths over which a target may change its trend, as shares of a parameter's range: some points lie within each."""


@dataclass(frozen=True)
class Surrogate:
    """What all goals are expected to be, at any point of the unit cube.

    Attributes
    ----------
    processes : list
        One fitted ``GaussianProcessRegressor`` a goal, of (response - value)/scale/size.
    sizes : list of float
        How large the residuals of each goal are.
    """

    processes: Sequence[Any]
    sizes: Sequence[float]

    def predict(self, x: Floats) -> tuple[Floats, Floats]:
        """Return means and deviations of all goals' residuals at (n, d) points: (n, goals) each."""
        told = [process.predict(x, return_std=True) for process in self.processes]
        mean = np.column_stack([size * mean for (mean, _), size in zip(told, self.sizes, strict=True)])
        return mean, np.column_stack([size * sd for (_, sd), size in zip(told, self.sizes, strict=True)])

    def slopes(self, x: Floats, step: float = 0.1) -> Floats:
        """Return the slopes of all residuals at one point over the whole range of each parameter: (goals, d)."""
        columns = []
        for axis in range(len(x)):
            ends = np.array([x, x])
            ends[0, axis], ends[1, axis] = max(0.0, x[axis] - step), min(1.0, x[axis] + step)
            low, high = self.predict(ends)[0]
            columns.append((high - low) / (ends[1, axis] - ends[0, axis]))
        return np.column_stack(columns)

    def believing(self, x: Floats) -> Surrogate:
        """Return what would be expected if a point (d,) gave just what is expected of it: only doubt shrinks there.

        Kriging believer: Ginsbourger, Le Riche and Carraro (2010), doi:10.1007/978-3-642-10701-6_6.
        """
        return Surrogate([_believer(process, x[None]) for process in self.processes], self.sizes)


def _believer(process: Any, x: Floats) -> Any:
    """Return a process with its own mean at (1, d) as one more value; lengths and variances stay."""
    from sklearn.gaussian_process import GaussianProcessRegressor

    again = GaussianProcessRegressor(process.kernel_, alpha=process.alpha, optimizer=None)
    return again.fit(np.vstack([process.X_train_, x]), np.append(process.y_train_, process.predict(x)))


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
        If too few points have a response.
    """
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, DotProduct, WhiteKernel

    processes, sizes = [], []
    for k, goal in enumerate(goals):
        told = np.array([(each[k].value, each[k].error) for each in responses])
        known = np.isfinite(told).all(axis=1)
        if known.sum() < LEAST_POINTS:
            raise ConfigError(f"only {known.sum()} points have a result for {goal.name}")
        residual, noise = (told[known, 0] - goal.value) / goal.scale, told[known, 1] / goal.scale
        sizes.append(max(float(np.abs(residual).max()), LEAST_NOISE))
        pooled = float(np.sqrt(np.mean(noise**2))) / sizes[-1]  # one point's few repeats tell little of its own
        kernel = ConstantKernel(1.0, (1e-2, 1e3)) * RBF(np.full(points.shape[1], 0.5), SMOOTH)
        kernel += ConstantKernel(1.0, (1e-2, 1e3)) * DotProduct(1.0, (1e-2, 1e2))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)  # a length at its bound: a parameter that does nothing
            if pooled == 0.0:  # no repeats: the points themselves have to tell
                guess = GaussianProcessRegressor(kernel + WhiteKernel(1e-2, (1e-8, 1.0)), n_restarts_optimizer=2)
                pooled = _noise_in(guess.set_params(random_state=0).fit(points[known], residual / sizes[-1]))
            variance = max(pooled, LEAST_NOISE) ** 2
            process = GaussianProcessRegressor(kernel, alpha=variance, n_restarts_optimizer=2, random_state=0)
            processes.append(process.fit(points[known], residual / sizes[-1]))
    return Surrogate(processes, sizes)


def _noise_in(process: Any) -> float:
    """Return the deviation of the noise that a process was fitted with."""
    return float(np.sqrt(process.kernel_.k2.noise_level))
