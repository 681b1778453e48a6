"""Verdicts: whether what a study found bears a statement out, with the numbers that say so."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.config.quantities import to_si
from clast.results.whole_file import whole_file
from clast.studies.expectation_config import CURVES, Expectation, Selection
from clast.studies.measures import unit_of
from clast.studies.selection import meets
from clast.studies.statistics import deviation_interval, statistic, values_of
from clast.studies.table import Row, Table, curves
from clast.studies.work import DONE, FAILED

REPRODUCED, NOT_REPRODUCED, OPEN = "reproduced", "not reproduced", "not decidable"
LEVEL = 0.05
"""Probability of an accident below which a difference counts as found."""

SHUFFLES = 1999
"""Permutations of the test of no influence."""


@dataclass(frozen=True)
class Verdict:
    """What one variant of a study says of one statement."""

    expectation: Expectation
    variant: str
    verdict: str
    evidence: str


def judge(table: Table, expectations: Sequence[Expectation]) -> list[Verdict]:
    """Return a verdict for every statement and variant."""
    found = []
    for expectation in expectations:
        for variant in table.variants:
            if not expectation.variants or variant in expectation.variants:
                found.append(_judged(table, expectation, variant))
    return found


def _judged(table: Table, expectation: Expectation, variant: str) -> Verdict:
    asked = [row for row in table.rows if row.task.variant == variant]
    meant = [row for row in asked if _is_meant(row, expectation)]
    failed = [row for row in meant if row.state == FAILED]
    if failed and len(failed) == len(meant):
        return Verdict(expectation, variant, OPEN, f"all {len(failed)} runs failed: {failed[0].cause}")
    every = table.done(variant)
    verdict, evidence = CHECKS[expectation.check](expectation, chosen(every, expectation.where), every)
    waiting = sum(row.state not in (DONE, FAILED) for row in meant)
    if failed:
        evidence += f"; {len(failed)} of {len(meant)} runs failed: {failed[0].cause}"
    if waiting:
        evidence += f"; {waiting} of {len(meant)} runs are still to be done"
    return Verdict(expectation, variant, verdict, evidence)


def _is_meant(row: Row, expectation: Expectation) -> bool:
    """Tell whether a statement is about a run, or compares with it."""
    selections = [expectation.where, *([expectation.than] if expectation.than else [])]
    return any(chosen([row], each) for each in selections)


def chosen(rows: Sequence[Row], selection: Selection) -> list[Row]:
    """Return the runs whose settings are selected."""
    return [row for row in rows if all(meets(row.setting(axis), wanted) for axis, wanted in selection.items())]


def trend(expectation: Expectation, rows: list[Row], every: list[Row]) -> tuple[str, str]:
    """Judge whether a measure grows or falls along an axis: by Spearman's rank correlation over all runs.

    A trend is not reproduced where two neighbouring points turn it round by more than their scatter (Welch's test,
    divided by the number of neighbours).
    """
    from scipy.stats import spearmanr

    axis = expectation.along or (rows[0].task.settings[0].axis if rows and rows[0].task.settings else "")
    pairs = [(row.value(axis), row.measures[expectation.measure]) for row in rows if _measured(row, expectation)]
    numbers = sorted({x for x, _ in pairs if isinstance(x, float)})
    if len(numbers) < 2:
        return OPEN, "fewer than two points have results"
    sign = 1.0 if expectation.check == "grows" else -1.0
    groups = [[sign * y for x, y in pairs if x == number and y is not None] for number in numbers]
    x = np.concatenate([[number] * len(group) for number, group in zip(numbers, groups, strict=True)])
    if np.ptp(np.concatenate(groups)) == 0.0:
        return OPEN, f"{expectation.measure} is {sign * groups[0][0]:.4g} in all {len(x)} runs"
    rho, chance = spearmanr(x, np.concatenate(groups))
    means = [sign * float(np.mean(group)) for group in groups]
    told = f"{', '.join(f'{m:.4g}' for m in means)} ({expectation.measure}); rank correlation {sign * rho:+.2f}"
    turned = [k for k in range(len(groups) - 1) if _less(groups[k + 1], groups[k], LEVEL / (len(groups) - 1))]
    told += f", p = {chance:.2g}, {len(x)} runs"
    if turned:
        where = ", ".join(f"{numbers[k]:.4g} to {numbers[k + 1]:.4g}" for k in turned)
        return NOT_REPRODUCED, f"{told}; turned round from {where}"
    if chance > LEVEL or not np.isfinite(rho):
        return OPEN, told
    return (REPRODUCED if rho > 0 else NOT_REPRODUCED), told


def _measured(row: Row, expectation: Expectation) -> bool:
    return row.measures.get(expectation.measure) is not None


def _less(a: list[float], b: list[float], level: float, paired: bool = False) -> bool:
    """Tell whether numbers are smaller than others, by more than scatter explains: one by one, or as a whole."""
    if len(a) < 2 or len(b) < 2:
        return False
    if np.ptp(a) == 0.0 and np.ptp(b) == 0.0:
        return a[0] < b[0]
    from scipy.stats import ttest_ind, ttest_rel

    if paired:
        return bool(ttest_rel(a, b, alternative="less").pvalue < level)
    return bool(ttest_ind(a, b, equal_var=False, alternative="less").pvalue < level)


def same(expectation: Expectation, rows: list[Row], every: list[Row]) -> tuple[str, str]:
    """Judge whether an axis has no influence: points differ by no more than repeats, or by less than a margin.

    The chance that points differ as much by accident comes from permuting them within every repeat, whose runs
    share their seeds.
    """
    data, repeat, point, scale = _observations(expectation, rows)
    labels = np.unique(point)
    if len(labels) < 2:
        return OPEN, "fewer than two points have results"
    away = _largest_distance(data, point, labels) / scale
    told = f"the point farthest from the mean of all differs by {away:.1%}, {len(labels)} points, {len(data)} runs"
    told += f", cut at {100.0 * expectation.up_to:.4g} % strain" if expectation.up_to is not None else ""
    if len(data) == len(labels):
        return (REPRODUCED if away <= expectation.within else OPEN), f"{told}; no repeats to tell scatter from"
    chance = _chance(data, repeat, point, labels)
    told = f"{told}, p = {chance:.2g}"
    if away <= expectation.within:
        return REPRODUCED, told
    return (NOT_REPRODUCED if chance < LEVEL else OPEN), told


Floats = NDArray[np.float64]


def _observations(expectation: Expectation, rows: list[Row]) -> tuple[Floats, Floats, Floats, float]:
    """Return what is compared, (runs, k), with repeat and point of each, and the size of it."""
    if expectation.measure == CURVES:
        rows = [row for row in rows if row.curve is not None]
        data = curves(rows, expectation.up_to)[1]
        scale = float(data.mean(axis=0).max()) if len(rows) else 1.0
    else:
        rows = [row for row in rows if _measured(row, expectation)]
        data = np.array([[row.measures[expectation.measure]] for row in rows], float).reshape(len(rows), 1)
        scale = float(abs(data.mean())) if len(rows) else 1.0
    repeat, point = (np.array([getattr(row.task, name) for row in rows], float) for name in ("repeat", "point"))
    return data, repeat, point, scale or 1.0


def _largest_distance(data: Floats, point: Floats, labels: Floats) -> float:
    means = np.array([data[point == label].mean(axis=0) for label in labels])
    return float(np.sqrt(np.mean((means - means.mean(axis=0)) ** 2, axis=1)).max())


def _chance(data: Floats, repeat: Floats, point: Floats, labels: Floats) -> float:
    random = np.random.default_rng(1)

    def between(order: Floats) -> float:
        return float(sum(np.sum(data[order == label].sum(axis=0) ** 2) / np.sum(order == label) for label in labels))

    found, above = between(point), 0
    for _ in range(SHUFFLES):
        order = point.copy()
        for each in np.unique(repeat):
            here = np.nonzero(repeat == each)[0]
            order[here] = point[random.permutation(here)]
        above += between(order) >= found * (1.0 - 1e-12)
    return (above + 1) / (SHUFFLES + 1)


def equals(expectation: Expectation, rows: list[Row], every: list[Row]) -> tuple[str, str]:
    """Judge whether the mean, or the deviation, is a value: by its confidence interval and the margin."""
    sample = values_of(rows, expectation.measure)
    if not sample or (expectation.of == "deviation" and len(sample) < 3):
        return OPEN, "too few runs have results"
    value = to_si(expectation.value, unit_of(expectation.measure))
    margin, found = expectation.within * abs(value), statistic(sample)
    got, low, high = found.mean, found.low, found.high
    if expectation.of == "deviation":
        got, (low, high) = found.deviation, deviation_interval(found)
    told = f"{found.mean:.4g} ± {found.deviation:.2g} ({expectation.measure}, {found.runs} runs)"
    told += f"; {expectation.of} between {low:.4g} and {high:.4g}" if len(sample) > 1 else ""
    told += f" against {value:.4g}"
    if abs(got - value) <= margin:
        return REPRODUCED, told
    return (NOT_REPRODUCED if low > value + margin or high < value - margin else OPEN), told


def larger(expectation: Expectation, rows: list[Row], every: list[Row]) -> tuple[str, str]:
    """Judge whether one selection of runs lies above, or below, another one: in pairs, or by Welch's test.

    Runs of one repeat share their seeds; so where both selections have one run of every repeat, their differences are
    judged by Student's test, which what all beds or grains of a repeat have in common does not blur.
    """
    others = chosen(every, expectation.than)
    first, second = values_of(rows, expectation.measure), values_of(others, expectation.measure)
    if not first or not second:
        return OPEN, "runs to compare are missing"
    told = f"{_told(first)} against {_told(second)} ({expectation.measure})"
    above = 1.0 if expectation.check == "larger" else -1.0
    pairs = _pairs(rows, others, expectation.measure)
    if pairs is not None:
        apart = [above * (x - y) for x, y in pairs]
        zero = [0.0] * len(apart)
        found, other = _less(zero, apart, LEVEL, paired=True), _less(apart, zero, LEVEL, paired=True)
        told += f"; differences in pairs {_told([x - y for x, y in pairs])}"
    else:
        low, high = (second, first) if above > 0.0 else (first, second)
        found, other = _less(low, high, LEVEL), _less(high, low, LEVEL)
    return (REPRODUCED if found else NOT_REPRODUCED if other else OPEN), told


def _pairs(rows: list[Row], others: list[Row], measure: str) -> list[tuple[float, float]] | None:
    """Return the values of two selections for each repeat, None where one of them has not one run of each."""
    first, second = (
        {row.task.repeat: value for row in each if (value := row.measures.get(measure)) is not None}
        for each in (rows, others)
    )
    if len(first) < 2 or first.keys() != second.keys() or (len(first), len(second)) != (len(rows), len(others)):
        return None
    return [(first[repeat], second[repeat]) for repeat in sorted(first)]


def _told(sample: list[float]) -> str:
    found = statistic(sample)
    return f"{found.mean:.4g} ± {found.deviation:.2g} ({found.runs} runs)"


CHECKS = {"grows": trend, "falls": trend, "same": same, "equals": equals, "larger": larger, "smaller": larger}


def write_verdicts(verdicts: Sequence[Verdict], path: Path) -> None:
    """Write one line a statement and variant."""
    with whole_file(path) as draft, draft.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["says", "source", "variant", "verdict", "evidence"])
        for each in verdicts:
            writer.writerow([each.expectation.says, each.expectation.source, each.variant, each.verdict, each.evidence])


def counts(verdicts: Sequence[Verdict]) -> Mapping[str, int]:
    """Return how often each verdict was given."""
    given: list[Any] = [each.verdict for each in verdicts]
    return {name: given.count(name) for name in (REPRODUCED, NOT_REPRODUCED, OPEN)}
