"""Measured: how numbers of tables are shown, by the unit in a measure's name and to the digits that are sure."""

from __future__ import annotations

from math import floor, isfinite, log10
from typing import NamedTuple

from clast.studies.readable import readable
from clast_viz.report.parameters import text_of


class Measure(NamedTuple):
    """How a measure is shown: its name, the text over its column, and the factor from SI."""

    name: str
    head: str
    factor: float


def measure(name: str) -> Measure:
    """Return how a measure is shown, by the unit at the end of its name.

    >>> measure("slope_5_15_Pa")
    Measure(name='slope_5_15_Pa', head='slope 5 15 [MPa]', factor=1e-06)
    """
    words, unit, factor = readable(name)
    return Measure(name, f"{words} [{unit}]" if unit else words, factor)


def scattered(mean: str, deviation: str, runs: str, factor: float) -> str:
    """Return a mean and its deviation, to two digits of the deviation; the mean alone of a single run.

    >>> scattered("3755429.5", "512000", "5", 1e-6), scattered("0.15343", "0", "1", 100)
    ('3.76 ± 0.51', '15.34')
    """
    try:
        value, spread = factor * float(mean), factor * float(deviation)
    except ValueError:
        return mean
    if runs == "1" or not isfinite(spread):
        return f"{value:.4g}"
    if spread == 0.0:
        return f"{value:.4g} ± 0"
    decimals = _decimals(spread)
    return f"{value:.{decimals}f} ± {spread:.{decimals}f}"


def within(value: str, low: str, high: str, factor: float) -> str:
    """Return a value and its interval, to two digits of half the interval.

    >>> within("3755429.5", "3400000", "4110859", 1e-6)
    '3.76 [3.40, 4.11]'
    """
    try:
        told, ends = factor * float(value), (factor * float(low), factor * float(high))
    except ValueError:
        return value
    half = 0.5 * (ends[1] - ends[0])
    if not isfinite(half) or half <= 0.0:
        return f"{told:.4g}"
    decimals = _decimals(half)
    return f"{told:.{decimals}f} [{ends[0]:.{decimals}f}, {ends[1]:.{decimals}f}]"


def _decimals(spread: float) -> int:
    """Return the decimals that leave two digits of a spread."""
    return max(0, 1 - floor(log10(abs(spread))))


def number(text: str) -> str:
    """Return a value of an axis, numbers to six digits.

    >>> number("0.00025000000000000001"), number("paper")
    ('0.00025', 'paper')
    """
    try:
        return text_of(float(f"{float(text):.6g}"))
    except ValueError:
        return text
