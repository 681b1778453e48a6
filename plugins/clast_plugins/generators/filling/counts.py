"""How many grains of each fraction: of the answers that number and mass leave, the nearest to a prior is taken.

The number of grains and their mass are two conditions on the counts; a height adds none, for it only tells how densely
the grains lie. With three fractions a family with one parameter is left.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.errors import ConfigError

Floats = NDArray[np.float64]
MOST_SCALING = 0.05
"""Share by which all diameters may be changed together so that the mass is met."""
ROUNDED = 0.005
"""What shares that a user rounded may lack of 1, or have more."""


class Share(NamedTuple):
    """What is known of one fraction: its name, mean mass of a grain in kg, and what the user says of its count.

    ``grains`` is their number; ``share`` the share of all grains; ``prior`` the share expected where neither is
    given.
    """

    name: str
    mass: float
    grains: int | None = None
    share: float | None = None
    prior: float | None = None


class Counts(NamedTuple):
    """Grains of each fraction (k,), and where number and mass leave a choice, what each could be (k, 2)."""

    grains: NDArray[np.int64]
    family: Floats | None


def counts(shares: Sequence[Share], grains: int | None, mass: float | None) -> Counts:
    """Return how many grains of each fraction there are.

    Parameters
    ----------
    shares : sequence of Share
    grains : int or None
        Number of all grains.
    mass : float or None
        Mass of all grains in kg.

    Raises
    ------
    ConfigError
        If what is given does not add up; ``at`` is the key.

    Examples
    --------
    Ten grains of 1 and 3 kg that weigh 16 kg together:

    >>> counts([Share("small", 1.0), Share("large", 3.0)], 10, 16.0).grains.tolist()
    [7, 3]
    """
    if all(each.grains is not None for each in shares):
        return Counts(_some(_all_given(shares, grains)), None)
    _refuse_shares(shares)
    if grains is None:
        raise ConfigError("not every fraction has its number of 'grains', so the number of all is needed", ("grains",))
    fixed = np.array([_fixed(each, grains) for each in shares])
    free = np.isnan(fixed)
    left = float(grains - np.nansum(fixed))
    if left < -0.5 or (not free.any() and abs(left) > 0.5):
        total = np.nansum(fixed)
        raise ConfigError(f"the fractions have {total:.0f} grains together, not {grains}", ("grains",))
    left = max(left, 0.0)
    if free.sum() <= 1:
        return Counts(_whole(np.where(free, left, fixed), grains), None)
    m = np.array([each.mass for each in shares])
    prior = _priors(shares, free) * left
    if mass is None:
        return Counts(_whole(np.where(free, prior, fixed), grains), None)
    rest = _possible(shares, free, left, mass - float(np.nansum(fixed * m)))
    found = fixed.copy()
    found[free] = nearest(prior[free], m[free], left, rest)
    family = np.column_stack([found, found])
    family[free] = extremes(m[free], left, rest)
    return Counts(_whole(found, grains), family if free.sum() > 2 else None)


def nearest(prior: Floats, mass: Floats, number: float, total: float) -> Floats:
    """Return the counts n ≥ 0 nearest to a prior with Σ n = number and Σ n·mass = total; all are (k,).

    Nearest in the sum of squared differences. Counts that come out below zero are set to zero, and the rest is solved
    anew.

    >>> nearest(np.array([4.0, 3.0, 3.0]), np.array([1.0, 2.0, 3.0]), 10.0, 20.0).round(6).tolist()
    [3.5, 3.0, 3.5]
    """
    found, kept = np.zeros(len(prior)), np.ones(len(prior), bool)
    while True:
        A = np.vstack([np.ones(int(kept.sum())), mass[kept]])
        lack = np.array([number, total]) - A @ prior[kept]
        found[:] = 0.0
        found[kept] = prior[kept] + np.linalg.lstsq(A, lack, rcond=None)[0]
        if kept.sum() <= 2 or (found >= -1e-9 * number).all():
            return np.maximum(found, 0.0)
        kept &= found > found.min()


def extremes(mass: Floats, number: float, total: float) -> Floats:
    """Return the least and the largest each count can be, (k, 2), with Σ n = number, Σ n·mass = total, n ≥ 0.

    >>> extremes(np.array([1.0, 2.0, 3.0]), 10.0, 20.0).round(6).tolist()
    [[0.0, 5.0], [0.0, 10.0], [0.0, 5.0]]
    """
    from scipy.optimize import linprog

    A, b = np.vstack([np.ones(len(mass)), mass / mass.mean()]), [number, total / mass.mean()]
    unit = np.eye(len(mass))
    ends = [[float(np.asarray(linprog(sign * row, A_eq=A, b_eq=b).x) @ row) for sign in (1.0, -1.0)] for row in unit]
    return np.array(ends)


def _all_given(shares: Sequence[Share], grains: int | None) -> NDArray[np.int64]:
    count = np.array([each.grains for each in shares], np.int64)
    if grains is not None and count.sum() != grains:
        raise ConfigError(f"the fractions have {count.sum()} grains together, not {grains}", ("grains",))
    return count


def _refuse_shares(shares: Sequence[Share]) -> None:
    """Refuse shares of more than all grains, and of less where no fraction is left for the rest."""
    total = sum(each.share or 0.0 for each in shares)
    complete = all(each.share is not None for each in shares)
    if total > 1.0 + ROUNDED or (complete and total < 1.0 - ROUNDED):
        most = "" if complete else "at most "
        raise ConfigError(f"the shares make {100.0 * total:.6g} %; {most}100 % is needed", ("fractions",))


def _fixed(each: Share, grains: int) -> float:
    if each.grains is not None:
        return float(each.grains)
    return np.nan if each.share is None else grains * each.share


def _some(count: NDArray[np.int64]) -> NDArray[np.int64]:
    if count.sum() == 0:
        raise ConfigError("no fraction has any grains; give a number above zero", ("fractions",))
    return count


def _priors(shares: Sequence[Share], free: NDArray[np.bool_]) -> Floats:
    """Return the shares expected of the free fractions, of all free grains.

    Those without a prior have what the others leave, in equal parts.
    """
    given = np.array([np.nan if each.prior is None else each.prior for each in shares])
    given[~free] = 0.0
    told, missing = float(np.nansum(given)), np.isnan(given)
    if told > 1.0 + 1e-9 or (told == 0.0 and not missing.any()):
        raise ConfigError(
            f"the 'prior' shares add up to {told:.4g}; more than 0 and at most 1 is needed", ("fractions",)
        )
    given[missing] = max(1.0 - told, 0.0) / max(int(missing.sum()), 1)
    return given / float(given.sum())


def _whole(count: Floats, grains: int) -> NDArray[np.int64]:
    """Round counts so that they still add up: the largest remainders are rounded up."""
    whole = np.floor(count + 1e-9).astype(np.int64)
    order = np.argsort(whole - count, kind="stable")
    whole[order[: grains - int(whole.sum())]] += 1
    return whole


def _possible(shares: Sequence[Share], free: NDArray[np.bool_], number: float, rest: float) -> float:
    """Return the mass in kg nearest to ``rest`` that the free grains can have; diameters may change by a little."""
    each = np.array([share.mass for share in shares])[free]
    most, least = number * each.max(), number * each.min()
    slack = (1.0 + MOST_SCALING) ** 3
    if not least / slack <= rest <= most * slack:
        names = ", ".join(share.name for share, one in zip(shares, free, strict=True) if one)
        raise ConfigError(
            f"{number:.0f} grains of {names} weigh {1e3 * least:.6g} to {1e3 * most:.6g} g, and {1e3 * rest:.6g} g are "
            "left for them; change 'mass', 'grains', the diameters, or the density",
            ("mass",),
        )
    return float(min(max(rest, least), most))
