"""Fraction: grains of one size class."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from clast.config.choice import Chosen, PartOf
from clast.config.quantities import Length, Number
from clast.parts.params import Params
from clast_plugins.generators.sizes import FARTHEST


class Fraction(Params):
    """Grains of one size class, made from a few packings, each grain turned at random and of a size of its own."""

    diameter: Annotated[Length, Field(gt=0, description="Mean diameter of the grains, that of the template")]
    deviation: Annotated[Length, Field(ge=0, description="Standard deviation of the diameter; 0: all are equal")] = 0.0
    between: Annotated[
        tuple[Length, Length] | None,
        Field(description="Smallest and largest diameter; by default three deviations from the mean"),
    ] = None
    grains: Annotated[int | None, Field(ge=0, le=1_000_000, description="Number of grains of this fraction")] = None
    share: Annotated[Number | None, Field(ge=0, le=1, description="Share of all grains, instead of `grains`")] = None
    prior: Annotated[
        Number | None,
        Field(ge=0, le=1, description="Share expected, where number and mass of all leave a choice; by default equal"),
    ] = None
    template: Annotated[Chosen, PartOf("generator"), Field(description="Generator of one grain of the mean diameter")]
    templates: Annotated[int, Field(ge=1, le=1000, description="Different packings made of it, with seeds in turn")] = 4

    @property
    def distribution(self) -> tuple[float, float, tuple[float, float] | None]:
        """Mean, deviation and bounds of the diameter in m."""
        return self.diameter, self.deviation, self.between

    @model_validator(mode="after")
    def _makes_sense(self) -> Fraction:
        given = [name for name in ("grains", "share", "prior") if getattr(self, name) is not None]
        if len(given) > 1:
            raise ValueError(f"only one of grains, share and prior can be given; given {' and '.join(given)}")
        if self.between is not None and not 0.0 < self.between[0] <= self.diameter <= self.between[1]:
            raise ValueError("'between' must be two diameters above zero, one below and one above the mean")
        if self.between is not None and self.deviation == 0.0:
            raise ValueError("'between' bounds a distribution, so it needs a 'deviation'")
        if self.between is None and self.deviation * FARTHEST >= self.diameter:
            raise ValueError(f"diameters reach {FARTHEST:g} deviations below the mean, here below zero; give 'between'")
        return self
