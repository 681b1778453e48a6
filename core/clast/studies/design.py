"""Design of a study: which points of the space of its axes are run."""

from __future__ import annotations

from itertools import product
from math import prod

import numpy as np
from numpy.typing import NDArray

from clast.errors import ConfigError
from clast.studies.axis import Axis, Setting
from clast.studies.config import SPACE_FILLING, StudyConfig
from clast.studies.selection import problems

Point = tuple[Setting, ...]

MOST = 100_000
"""Runs of a study; each is a folder and some memory."""


def axes(study: StudyConfig) -> list[Axis]:
    """Return the axes of a study.

    Raises
    ------
    ConfigError
        Values that cannot be read, or that the design cannot use.
    """
    found = []
    for name, config in study.vary.items():
        try:
            axis = Axis(name, config)
        except ValueError as error:
            raise study.problem(("vary", name), str(error)) from None
        if axis.only_drawn and study.design not in SPACE_FILLING:
            what = "a distribution" if config.distribution else "a range without 'points'"
            raise study.problem(("vary", name), f"{what} needs a design that draws: {', '.join(SPACE_FILLING)}")
        found.append(axis)
    wrong = list(problems(study.expect, found))
    if wrong:
        raise ConfigError(study.document.report(wrong))
    return found


def points(study: StudyConfig) -> list[Point]:
    """Return the points of a study, each with one setting an axis.

    Raises
    ------
    ConfigError
        As :func:`axes`; and axes of different lengths side by side.
    """
    found = axes(study)
    _refuse_too_many(study, found)
    if study.design == "grid":
        return list(product(*(axis.settings for axis in found)))
    if study.design == "together":
        lengths = {axis.name: len(axis.settings) for axis in found}
        if len(set(lengths.values())) > 1:
            told = ", ".join(f"{name} has {length}" for name, length in lengths.items())
            raise study.problem(("design",), f"'together' needs as many values on every axis: {told}")
        return list(zip(*(axis.settings for axis in found), strict=True)) or [()]
    shares = quantiles(study.design, study.points or 1, len(found), study.seed)
    return [tuple(axis.at(float(share)) for axis, share in zip(found, row, strict=True)) for row in shares]


def _refuse_too_many(study: StudyConfig, found: list[Axis]) -> None:
    lengths = [len(axis.settings) for axis in found]
    count = study.points or (prod(lengths) if study.design == "grid" else max(lengths, default=1))
    runs = count * study.repeats * len(study.variant_changes)
    if runs > MOST:
        told = f"{runs:,} runs, where a study may have {MOST:,}"
        raise study.problem(("vary",), f"{told}; take fewer values or repeats, or points that fill the space")


def quantiles(design: str, count: int, dimensions: int, seed: int) -> NDArray[np.float64]:
    """Return points between 0 and 1 that fill the space: (count, dimensions).

    ``sobol`` is scrambled (Owen 1998), ``latin_hypercube`` that of McKay, Beckman and Conover (1979), both from
    ``scipy.stats.qmc``; ``random`` is independent.
    """
    if dimensions == 0:
        return np.zeros((count, 0))
    if design == "random":
        return np.random.default_rng(seed).random((count, dimensions))
    from scipy.stats import qmc

    if design == "latin_hypercube":
        return np.asarray(qmc.LatinHypercube(dimensions, rng=seed).random(count))
    power = int(np.ceil(np.log2(max(count, 1))))
    return np.asarray(qmc.Sobol(dimensions, rng=seed).random_base2(power)[:count])
