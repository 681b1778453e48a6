"""An axis at work: its settings one by one, or the setting at a quantile."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import exp, gamma, isfinite, log, sqrt
from typing import Any

import numpy as np

from clast.config.quantities import read_quantity, written_unit
from clast.config.units import si_unit, unit_factor
from clast.maths.distributions import weibull_deviation
from clast.studies.axis_config import AxisConfig

LEAST_KEPT = 1e-6
"""Share of a distribution that its ends must leave: beyond, quantiles are lost in rounding."""


@dataclass(frozen=True)
class Setting:
    """One value of one axis.

    Attributes
    ----------
    axis : str
    label : str
        As a user reads it.
    number : float or None
        In SI; None where the value is no quantity.
    changes : mapping
        Key path in the scene -> value.
    factors : mapping
        Key path -> what its value is multiplied with.
    unit : str
        In which the axis is written; empty where it is not.
    slug : str
        As names of runs have it, which stay whatever a user reads; by default the label.
    """

    axis: str
    label: str
    number: float | None
    changes: dict[str, Any]
    factors: dict[str, float] = field(default_factory=dict)
    unit: str = ""
    slug: str = ""

    @property
    def shown(self) -> float | None:
        """The number in the unit in which the axis is written."""
        return self.number if self.number is None or not self.unit else self.number / float(unit_factor(self.unit)[0])


class Axis:
    """One axis of a study.

    Parameters
    ----------
    name : str
        Key path in the scene, or any name where ``config`` has ``keys``.
    config : AxisConfig

    Attributes
    ----------
    settings : tuple of Setting
        All values of a list or a range; none of a distribution, or of a range without ``points``.

    Raises
    ------
    ValueError
        Ends of another dimension, a logarithmic range that touches zero, factors for what is no number.
    """

    def __init__(self, name: str, config: AxisConfig) -> None:
        self.name, self.config = name, config
        self.unit = _unit(config)
        self.dimension = unit_factor(self.unit)[1] if self.unit else None
        self._scaled = isinstance(config.keys, dict)
        self.factors = dict(config.keys) if isinstance(config.keys, dict) else dict.fromkeys(config.sets(name), 1.0)
        if config.distribution is not None:
            self._check_distribution()
        elif config.values is None:
            self._check_range()
        self.settings = tuple(self._settings())

    def at(self, share: float) -> Setting:
        """Return the setting at a quantile between 0 and 1."""
        if self.config.values is not None:
            return self.settings[min(int(share * len(self.settings)), len(self.settings) - 1)]
        return self._number(self._drawn(share) if self.config.distribution is not None else self._between(share))

    def slope(self, share: float) -> float:
        """Return how the number of a range changes with the share of it, in SI for the whole range."""
        (low, _), (high, _) = read_quantity(self.config.start), read_quantity(self.config.to)
        return self._between(share) * log(high / low) if self.config.spacing == "log" else high - low

    @property
    def only_drawn(self) -> bool:
        """Whether values are drawn, so that there is no list of them."""
        return not self.settings

    def _settings(self) -> list[Setting]:
        values = self.config.values
        if isinstance(values, dict):
            return [self._written(label, value) for label, value in values.items()]
        if values is not None:
            return [self._written(_short(value), value) for value in values]
        if self.config.points is None or self.config.distribution is not None:
            return []
        shares = np.linspace(0.0, 1.0, self.config.points) if self.config.points > 1 else [0.0]
        return [self._number(self._between(float(share))) for share in shares]

    def _written(self, label: str, value: Any) -> Setting:
        number = _number_of(value)
        if self.config.scales and number is not None:
            return self._number(number, label)
        if not self._scaled:
            return self._setting(label, number, dict.fromkeys(self.factors, value))
        if number is None:
            raise ValueError(f"{value!r} is no number, so that it cannot be multiplied with the factors of 'keys'")
        return self._setting(label, number, {key: factor * number for key, factor in self.factors.items()})

    def _number(self, number: float, label: str = "") -> Setting:
        unit = "" if self.dimension is None else si_unit(self.dimension)
        changes = {key: _with_unit(factor * number, unit) for key, factor in self.factors.items()}
        found = self._setting(label, number, changes, dict.fromkeys(self.config.scales, number))
        return found if label else replace(found, label=f"{found.shown:.6g} {self.unit}".strip(), slug=f"{number:.6g}")

    def _setting(
        self, label: str, number: float | None, changes: dict[str, Any], factors: dict[str, float] | None = None
    ) -> Setting:
        return Setting(self.name, label, number, changes, factors or {}, self.unit, label)

    def _between(self, share: float) -> float:
        (low, _), (high, _) = read_quantity(self.config.start), read_quantity(self.config.to)
        if share in (0.0, 1.0):
            return high if share else low
        if self.config.spacing == "log":
            return exp(log(low) + share * (log(high) - log(low)))
        return low + share * (high - low)

    def _drawn(self, share: float) -> float:
        low, high = self._kept()
        return float(self._distribution().ppf(low + share * (high - low)))

    def _kept(self) -> tuple[float, float]:
        """Return the quantiles of the whole distribution at which it is cut off."""
        found = self._distribution()
        low, high = (float(found.cdf(read_quantity(each)[0])) if each is not None else k for k, each in self._cuts())
        return low, high

    def _distribution(self) -> Any:
        """Return the distribution of scipy with this mean and deviation."""
        from scipy import stats

        mean, deviation = self._moments()
        if self.config.distribution == "normal":
            return stats.norm(mean, deviation)
        if self.config.distribution == "lognormal":
            width = sqrt(log(1.0 + (deviation / mean) ** 2))
            return stats.lognorm(width, scale=mean * exp(-0.5 * width**2))
        modulus = weibull_modulus(deviation / mean)
        return stats.weibull_min(modulus, scale=mean / gamma(1.0 + 1.0 / modulus))

    def _moments(self) -> tuple[float, float]:
        return read_quantity(self.config.mean)[0], read_quantity(self.config.deviation)[0]

    def _cuts(self) -> tuple[tuple[float, Any], tuple[float, Any]]:
        return (0.0, self.config.at_least), (1.0, self.config.at_most)

    def _check_range(self) -> None:
        (low, one), (high, other) = read_quantity(self.config.start), read_quantity(self.config.to)
        if one != other:
            raise ValueError(f"'from' ({self.config.start}) and 'to' ({self.config.to}) are not of one dimension")
        if self.config.spacing == "log" and low * high <= 0.0:
            raise ValueError("a logarithmic range needs two ends of one sign, and none of them 0")

    def _check_distribution(self) -> None:
        dimensions = {
            read_quantity(each)[1]
            for each in (self.config.mean, self.config.deviation, self.config.at_least, self.config.at_most)
            if each is not None
        }
        if len(dimensions) > 1:
            raise ValueError("mean, deviation and ends of a distribution are not of one dimension")
        mean, deviation = self._moments()
        if deviation <= 0.0 or (mean <= 0.0 and self.config.distribution != "normal"):
            raise ValueError(f"a {self.config.distribution} distribution needs a deviation and a mean above 0")
        low, high = self._kept()
        if high - low < LEAST_KEPT:
            cuts = {"at_least": self.config.at_least, "at_most": self.config.at_most}
            told = " and ".join(f"{name} {each}" for name, each in cuts.items() if each is not None)
            raise ValueError(
                f"{told}: next to nothing of the distribution with mean {self.config.mean} and deviation "
                f"{self.config.deviation} lies there; choose other cut-offs"
            )


def _unit(config: AxisConfig) -> str:
    """Return the unit in which a user wrote an axis; empty for bare numbers, and for what is no number."""
    values = config.values.values() if isinstance(config.values, dict) else config.values or ()
    for given in (config.start, config.to, config.mean, *values):
        unit = written_unit(given)
        try:
            unit_factor(unit or "1")
        except ValueError:  # a name that looks like a quantity
            continue
        if unit:
            return unit
    return ""


def _with_unit(number: float, unit: str) -> float | str:
    """Return a number in SI as the scene reads it, so that its dimension is checked there."""
    return f"{number!r} {unit}" if unit else number


def weibull_modulus(share: float) -> float:
    """Return the modulus of the Weibull distribution whose deviation is a share of its mean.

    >>> round(weibull_modulus(0.5), 2)
    2.1
    """
    from scipy.optimize import brentq

    return float(brentq(lambda modulus: weibull_deviation(modulus) - share, 0.1, 1e3))


def _number_of(value: Any) -> float | None:
    try:
        number = read_quantity(value)[0]
    except ValueError:
        return None
    return number if isfinite(number) else None


def _short(value: Any) -> str:
    if isinstance(value, dict):
        return str(value.get("type", value))
    return str(value)
