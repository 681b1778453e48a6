"""What a sweep shows, in a sentence: how much less CPU time one way needs than another for the same error."""

from __future__ import annotations

from itertools import pairwise
from math import ceil, floor, log10
from typing import NamedTuple

import numpy as np

from clast.bench.precision.sweep import Point, Series, Swept


class Gain(NamedTuple):
    """``fast`` needs ``times`` less CPU time than ``slow`` at ``error``."""

    error: float
    fast: Series
    slow: Series
    times: float


def known(series: Series) -> list[Point]:
    """Return the runs whose error the reference can tell."""
    return [point for point in series.points if point.error > 3.0 * series.floor and point.cpu_s > 0.0]


def cpu_for(series: Series, error: float) -> float | None:
    """Return the CPU s that an error costs, by straight lines in logarithms.

    That of the coarsest run where this is more exact already; None where no run is exact enough.
    """
    points = known(series)
    if points and points[0].error <= error:
        return points[0].cpu_s
    for coarse, fine in pairwise(points):
        if fine.error <= error < coarse.error:
            share = np.log(coarse.error / error) / np.log(coarse.error / fine.error)
            return float(coarse.cpu_s * (fine.cpu_s / coarse.cpu_s) ** share)
    return None


def gain(found: Swept) -> Gain | None:
    """Return how much less CPU time the scene's own choice needs than the peer, or than Clast's worst without one.

    At the smallest error, a whole number of a power of ten, that the other reaches; None where the own does not.
    """
    ready = [series for series in found.series if len(known(series)) > 1]
    own = next((each for each in ready if each.way == found.own), None)
    others = [each for each in ready if each is not own]
    peers = [each for each in others if each.program != "Clast"]
    if own is None or not others:
        return None
    slow = max(peers or others, key=least_error)
    error = rounded_up(max(least_error(slow), least_error(own)))
    mine, its = cpu_for(own, error), cpu_for(slow, error)
    return None if mine is None or its is None else Gain(error, own, slow, its / mine)


def gains(found: Swept) -> list[Gain]:
    """Return what :func:`gain` does, at the error of every run of the slower one that the faster one reaches."""
    last = gain(found)
    if last is None:
        return []
    runs = [(point, cpu_for(last.fast, point.error)) for point in known(last.slow)]
    return [Gain(point.error, last.fast, last.slow, point.cpu_s / mine) for point, mine in runs if mine is not None]


def least_error(series: Series) -> float:
    """Return the smallest error that is known."""
    return min(point.error for point in known(series))


def rounded_up(error: float) -> float:
    """Return the next larger number with one digit.

    >>> rounded_up(0.0132)
    0.02
    """
    power = floor(log10(error))
    return ceil(error / 10.0**power) / 10.0**-power if power < 0 else ceil(error)


def sentence(found: Gain | None) -> str:
    """Say it."""
    if found is None:
        return "There is nothing to compare"
    if found.times < 0.95:
        more = f"{times(1.0 / found.times)} times more CPU time than {found.slow.label}"
        return f"At an error of {share(found.error)}, {found.fast.label} needs {more}"
    if found.times < 1.05:
        return f"At an error of {share(found.error)}, {found.fast.label} needs as much CPU time as {found.slow.label}"
    return (
        f"At an error of {share(found.error)}, {found.fast.label} needs {times(found.times)} times less CPU time than "
        f"{found.slow.label}"
    )


def times(value: float) -> str:
    """Write a ratio with two digits.

    >>> times(23.4), times(3.14), times(140.2)
    ('23', '3.1', '140')
    """
    return f"{value:.1f}" if value < 9.95 else f"{float(f'{value:.2g}'):.0f}"


def share(error: float) -> str:
    """Write a relative error.

    >>> share(0.02), share(0.0004), share(3e-6)
    ('2 %', '0.04 %', '3e-06')
    """
    return f"{100.0 * error:.2g} %" if error >= 1e-4 else f"{error:.0e}"
