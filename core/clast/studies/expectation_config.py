"""A statement about a study, as a user writes it, so that a program can check it."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from clast.config.quantities import Number
from clast.parts.params import Params
from clast.studies.axis_config import BY_NAME, MAPPING_OR_NOT, OTHERWISE, Given

CURVES = "curves"
"""Name of the measure that is the whole stress-strain curve."""


class Range(Params):
    """Which values of an axis are meant."""

    at_least: Given | None = None
    above: Given | None = None
    at_most: Given | None = None
    below: Given | None = None

    @model_validator(mode="after")
    def _something(self) -> Range:
        if self == Range.model_construct():
            raise ValueError("give at_least, above, at_most or below")
        return self


Selection = dict[str, Annotated[Annotated[Range, BY_NAME] | Annotated[Given, OTHERWISE], MAPPING_OR_NOT]]


class Expectation(Params):
    """One statement; it is checked for every variant by itself."""

    says: Annotated[str, Field(description="The statement in words")]
    source: Annotated[str, Field(description="Who says so, and where")] = ""
    variants: Annotated[tuple[str, ...], Field(description="Variants it is checked for; all, if none is named")] = ()
    check: Annotated[
        Literal["grows", "falls", "same", "equals", "larger", "smaller"],
        Field(description="A trend along an axis, no influence, a value, or one selection against another"),
    ]
    measure: Annotated[str, Field(description="What is looked at: a column of runs.csv, or 'curves'")] = CURVES
    along: Annotated[str | None, Field(description="Axis of a trend; the only one, if not given")] = None
    where: Annotated[Selection, Field(description="Axis -> value or range: runs that are meant")] = Field(
        default_factory=dict
    )
    than: Annotated[Selection, Field(description="Runs that those are compared with")] = Field(default_factory=dict)
    of: Annotated[Literal["mean", "deviation"], Field(description="What of the measure 'equals' is about")] = "mean"
    value: Annotated[Given | None, Field(description="What 'equals' expects")] = None
    within: Annotated[Number, Field(gt=0, description="Share by which 'same' and 'equals' may differ")] = 0.1
    up_to: Annotated[
        Number | None, Field(gt=0, description="Strain up to which curves are compared; all they have, if not given")
    ] = None

    @model_validator(mode="after")
    def _what_each_check_needs(self) -> Expectation:
        if self.measure == CURVES and self.check != "same":
            raise ValueError(f"'{self.check}' needs a 'measure' that is one number; curves can only be the 'same'")
        if self.up_to is not None and self.measure != CURVES:
            raise ValueError(f"'up_to' is a strain at which curves are cut; {self.measure!r} is one number a run")
        if (self.check == "equals") != (self.value is not None):
            raise ValueError("'value' belongs to 'equals', and 'equals' needs it")
        if (self.check in ("larger", "smaller")) != bool(self.than):
            raise ValueError("'than' belongs to 'larger' and 'smaller', and they need it")
        return self


def plain(selection: Selection) -> dict[str, Any]:
    """Return a selection as a user would write it."""
    return {
        axis: each.model_dump(exclude_none=True) if isinstance(each, Range) else each
        for axis, each in selection.items()
    }
