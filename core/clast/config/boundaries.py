"""Boundaries of a scene: a box that holds it, or repeats it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from clast.config.problems import wrong
from clast.config.quantities import Point, StrainRates
from clast.parts.params import Params


class Domain(Params):
    """A box; particles that leave it are removed and counted, but for directions in which it repeats itself."""

    lower: Annotated[Point, Field(description="Corner with the smallest coordinates")]
    upper: Annotated[Point, Field(description="Corner with the largest coordinates")]
    periodic: Annotated[
        tuple[Literal["x", "y", "z"], ...],
        Field(
            examples=[["x", "y"]],
            description="Directions in which the box is followed by its own images: what leaves at one face comes in "
            "at the other, and bonds and contacts reach across",
        ),
    ] = ()
    strain_rate: Annotated[
        StrainRates | None,
        Field(description="Rates at which the box grows along x, y and z about its middle, 0 where it is not periodic"),
    ] = None
    strain_measure: Annotated[
        Literal["logarithmic", "engineering"],
        Field(description="Strain of which the rate stays: ln(L/L0), or L/L0 - 1"),
    ] = "logarithmic"

    @model_validator(mode="after")
    def _is_a_box(self) -> Domain:
        if any(low >= high for low, high in zip(self.lower, self.upper, strict=True)):
            raise wrong("upper", "every coordinate of 'lower' must be smaller than that of 'upper'")
        for axis, rate in zip("xyz", self.strain_rate or (), strict=False):
            if rate != 0.0 and axis not in self.periodic:
                text = f"strain_rate stretches the box along {axis}, where it is not periodic; add it there"
                raise wrong("strain_rate", text)
        return self


class Boundaries(Params):
    """Limits of the scene."""

    domain: Annotated[Domain | None, Field(description="Box that holds the scene, or repeats it")] = None
