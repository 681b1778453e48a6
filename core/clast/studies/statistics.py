"""Statistics of a study: mean, deviation and confidence interval at every point."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from math import inf, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from clast.results.whole_file import whole_file
from clast.studies.table import Row, Table

LEVEL = 0.95


class Statistic(NamedTuple):
    """Mean, sample standard deviation and confidence interval of the mean of some numbers."""

    mean: float
    deviation: float
    runs: int
    low: float
    high: float


def statistic(values: Sequence[float], level: float = LEVEL) -> Statistic:
    """Return the statistic of a sample, with Student's interval; infinitely wide where there is one number only.

    >>> statistic([1.0, 2.0, 3.0]).mean
    2.0
    """
    sample = np.asarray(values, float)
    mean = float(sample.mean())
    if len(sample) < 2:
        return Statistic(mean, 0.0, len(sample), -inf, inf)
    from scipy.stats import t

    deviation = float(sample.std(ddof=1))
    half = float(t.ppf(0.5 + 0.5 * level, len(sample) - 1)) * deviation / sqrt(len(sample))
    return Statistic(mean, deviation, len(sample), mean - half, mean + half)


def deviation_interval(found: Statistic, level: float = LEVEL) -> tuple[float, float]:
    """Return the confidence interval of the deviation of a normal sample (chi square).

    >>> low, high = deviation_interval(statistic([1.0, 2.0, 3.0]))
    >>> round(low, 2), round(high, 2)
    (0.52, 6.28)
    """
    from scipy.stats import chi2

    free = found.runs - 1
    ends = (float(chi2.ppf(0.5 + sign * 0.5 * level, free)) for sign in (1.0, -1.0))
    low, high = (found.deviation * sqrt(free / end) for end in ends)
    return low, high


def values_of(rows: Sequence[Row], name: str) -> list[float]:
    """Return what runs measured; those that did not are left out."""
    return [value for row in rows if (value := row.measures.get(name)) is not None]


def write_statistics(table: Table, path: Path) -> None:
    """Write one line a point and measure."""
    heads = ["variant", "point", *table.axes, "measure", "mean", "deviation", "runs", "low", "high"]
    with whole_file(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heads)
        for variant in table.variants:
            for point, rows in table.points(variant):
                values = [rows[0].value(axis) for axis in table.axes]
                for name in table.measures:
                    sample = values_of(rows, name)
                    if sample:
                        told = [f"{x:.9g}" if isinstance(x, float) else x for x in statistic(sample)]
                        writer.writerow([variant, point, *values, name, *told])
