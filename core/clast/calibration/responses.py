"""Responses: what a point of the parameter space gives for every target, and how sure that is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import NamedTuple

import numpy as np

from clast.calibration.config import CURVE, CalibrationConfig
from clast.config.quantities import to_si
from clast.studies.measures import unit_of
from clast.studies.statistics import statistic, values_of
from clast.studies.table import Row, curves


@dataclass(frozen=True)
class Goal:
    """One number to be met.

    Attributes
    ----------
    name : str
        The measure; with "scatter of" in front where its deviation is meant.
    measure : str
    of_scatter : bool
    value : float
        In SI.
    scale : float
        Distance from the value that counts as one.
    """

    name: str
    measure: str
    of_scatter: bool
    value: float
    scale: float


class Response(NamedTuple):
    """A number at a point, with its standard error; not a number where no run has it."""

    value: float
    error: float


NOTHING = Response(float("nan"), float("nan"))


def goals(config: CalibrationConfig) -> list[Goal]:
    """Return all numbers to be met: means, scatters, and the distance from a curve."""
    found = []
    for measure, target in config.targets.items():
        if target.value is not None:
            value = to_si(target.value, unit_of(measure))
            found.append(Goal(measure, measure, False, value, target.within * abs(value)))
        if target.scatter is not None:
            value = to_si(target.scatter, unit_of(measure))
            found.append(Goal(f"scatter of {measure}", measure, True, value, target.scatter_within * abs(value)))
        if target.file is not None:
            found.append(Goal("distance from the curve", CURVE, False, 0.0, target.within))
    return found


def respond(config: CalibrationConfig, goal: Goal, rows: Sequence[Row]) -> Response:
    """Return what the runs of one point give for a goal."""
    if goal.measure == CURVE:
        return distance(config, rows)
    sample = values_of(rows, goal.measure)
    if len(sample) < (3 if goal.of_scatter else 1):
        return NOTHING
    found = statistic(sample)
    if goal.of_scatter:  # standard error of the deviation of a normal sample
        return Response(found.deviation, found.deviation / sqrt(2.0 * (found.runs - 1)))
    return Response(found.mean, found.deviation / sqrt(found.runs))


def distance(config: CalibrationConfig, rows: Sequence[Row]) -> Response:
    """Return the rms distance of the mean curve from the measured one, as a share of the measured peak."""
    with_curves = [row for row in rows if row.curve is not None]
    if not with_curves:
        return NOTHING
    strain, stress = config.measured_curve()
    grid, computed, _ = curves(with_curves)
    inside = (grid >= strain[0]) & (grid <= strain[-1])
    if not inside.any():
        return NOTHING
    wanted = np.interp(grid[inside], strain, stress)
    away = (computed[:, inside] - wanted) / np.abs(stress).max()
    mean = float(np.sqrt(np.mean(away.mean(axis=0) ** 2)))
    spread = away.std(axis=0, ddof=1).mean() / sqrt(len(away)) if len(away) > 1 else 0.0
    return Response(mean, float(spread))
