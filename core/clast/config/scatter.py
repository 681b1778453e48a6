"""Scatter of the bonds: what a user writes under ``bonds.scatter``, and whether the bond model can do it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import InitErrorDetails

from clast.config.choice import Chosen, plain_fields
from clast.config.problems import problem
from clast.config.quantities import Number
from clast.parts.params import Params
from clast.plugins.nearest import suggestion

SMALLEST_MODULUS, LARGEST_DEVIATION = 0.5, 10.0
"""Beyond them a few bonds carry the mean, which no grain has enough bonds to reach."""
MEASURES = {"weibull": "modulus", "lognormal": "deviation"}
"""By distribution: the key that says how wide it is."""


class Scatter(Params):
    """A random factor of mean 1 for each bond, the same for all parameters named here."""

    parameters: Annotated[
        tuple[str, ...],
        Field(min_length=1, description="Numbers of the bond model that are multiplied, all of a bond by one factor"),
    ]
    distribution: Annotated[Literal["weibull", "lognormal"], Field(description="Distribution of the factors, mean 1")]
    modulus: Annotated[
        Number | None, Field(ge=SMALLEST_MODULUS, description="Weibull modulus m, for weibull; 5 scatters by 23 %")
    ] = None
    deviation: Annotated[
        Number | None,
        Field(gt=0, le=LARGEST_DEVIATION, description="Standard deviation of the factors, for lognormal"),
    ] = None
    seed: Annotated[int, Field(ge=0, lt=2**32, description="Start of the random numbers; same seed, same factors")] = 1

    @model_validator(mode="after")
    def _has_the_measure_of_its_distribution(self) -> Scatter:
        for name, key in MEASURES.items():
            given = getattr(self, key) is not None
            if given and name != self.distribution:
                raise ValueError(
                    f"{key!r} is the measure of {name}; {self.distribution} takes {MEASURES[self.distribution]!r}"
                )
            if not given and name == self.distribution:
                raise ValueError(f"a {name} distribution needs {key!r}, which says how wide it is; add it")
        return self


def can_scatter(params: Params) -> list[str]:
    """Return the names of the parameters that are numbers other than 0."""
    return [name for name, value in plain_fields(params).items() if isinstance(value, float) and value != 0.0]


def scatter_problems(entries: Sequence[Scatter], model: Chosen) -> Iterator[InitErrorDetails]:
    """Find the parameters named that a bond model does not have, or has but cannot scatter."""
    seen: dict[str, int] = {}
    for k, entry in enumerate(entries):
        for i, name in enumerate(entry.parameters):
            text = _wrong(name, model)
            if name in seen:
                text = f"{name!r} has a factor already, that of entry {seen[name]}; remove one of the two"
            if text:
                yield problem(("scatter", k, "parameters", i), text, name)
            seen.setdefault(name, k)


def _wrong(name: str, model: Chosen) -> str:
    """Return why a parameter cannot scatter; nothing where it can."""
    possible = can_scatter(model.params)
    if name in possible:
        return ""
    if name not in type(model.params).model_fields:
        return f"bond model {model.name!r} has no parameter {name!r}; {suggestion(name, possible)}"
    value = getattr(model.params, name)
    if value is None:
        return f"bonds.model gives no {name!r} that could be multiplied; give it there, or remove it here"
    if value == 0.0 and isinstance(value, float):
        return f"{name!r} is 0 in bonds.model, and so is any multiple of it; give it another value, or remove it here"
    return f"{name!r} is no number that can be multiplied; such are {', '.join(possible)}"
