"""An axis as a user writes it: a list of values, a range, or a distribution."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from numbers import Real
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Discriminator, Field, PlainValidator, Tag, model_validator

from clast.config.problems import short
from clast.parts.params import Params


def _number_or_text(given: Any) -> float | str:
    if isinstance(given, str):
        return given
    if isinstance(given, bool) or not isinstance(given, Real) or not isfinite(given):
        raise ValueError(f"a finite number, or a text of number and unit, is needed; given {short(given)}")
    return float(given)


Given = Annotated[
    float | str, PlainValidator(_number_or_text), Field(description="A number, or a text of number and unit")
]

BY_NAME, OTHERWISE = Tag("<by name>"), Tag("<otherwise>")


def _shape(given: Any) -> str:
    return (BY_NAME if isinstance(given, Mapping) else OTHERWISE).tag


MAPPING_OR_NOT = Discriminator(_shape)
"""Chooses by its looks what a value is to be, so that what is wrong with it is told once."""

Keys = Annotated[Annotated[dict[str, float], BY_NAME] | Annotated[tuple[str, ...], OTHERWISE], MAPPING_OR_NOT]
Values = Annotated[
    Annotated[dict[str, Any], Field(min_length=1), BY_NAME] | Annotated[list[Any], Field(min_length=1), OTHERWISE],
    MAPPING_OR_NOT,
]


class AxisConfig(Params):
    """What one axis of a study varies. A list alone stands for ``values``."""

    model_config = ConfigDict(populate_by_name=True)

    keys: Annotated[
        Keys | None,
        Field(
            description="Keys that the value is given to, all alike or each times a factor; else the axis is the key"
        ),
    ] = None
    scales: Annotated[
        tuple[str, ...], Field(description="Keys whose value, as it is at the point, is multiplied by this one")
    ] = ()
    values: Annotated[Values | None, Field(description="Values, or values by name")] = None
    start: Annotated[Given | None, Field(alias="from", description="First value of a range")] = None
    to: Annotated[Given | None, Field(description="Last value of a range")] = None
    points: Annotated[int | None, Field(ge=1, le=100_000, description="Values of a range, both ends included")] = None
    spacing: Annotated[Literal["linear", "log"], Field(description="How a range is divided")] = "linear"
    distribution: Annotated[
        Literal["normal", "lognormal", "weibull"] | None, Field(description="What values are drawn from")
    ] = None
    mean: Annotated[Given | None, Field(description="Of the distribution")] = None
    deviation: Annotated[Given | None, Field(description="Standard deviation of the distribution")] = None
    at_least: Annotated[Given | None, Field(description="Where the distribution is cut off below")] = None
    at_most: Annotated[Given | None, Field(description="Where the distribution is cut off above")] = None

    def sets(self, name: str) -> tuple[str, ...]:
        """Return the keys that are given the value, where the axis has this name."""
        if self.scales:
            return ()
        return (name,) if self.keys is None else tuple(self.keys)

    @model_validator(mode="before")
    @classmethod
    def _list_is_values(cls, given: Any) -> Any:
        return {"values": given} if isinstance(given, list | tuple) else given

    @model_validator(mode="after")
    def _one_of_three(self) -> AxisConfig:
        ways = [self.values is not None, self.start is not None or self.to is not None, self.distribution is not None]
        if sum(ways) != 1:
            raise ValueError("give one of: a list of values, a range (from, to), a distribution")
        if ways[1] and (self.start is None or self.to is None):
            raise ValueError("a range needs 'from' and 'to'")
        if ways[2] and (self.mean is None or self.deviation is None):
            raise ValueError(f"distribution '{self.distribution}' needs 'mean' and 'deviation'")
        if self.scales and self.keys is not None:
            raise ValueError("'keys' are given the value, 'scales' are multiplied by it; give one of them")
        return self
