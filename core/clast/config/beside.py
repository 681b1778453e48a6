"""Parts whose own keys stand beside keys of Clast: a wall's shape, and the neighbour search."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationError, ValidationInfo
from pydantic_core import CoreSchema, InitErrorDetails, core_schema

from clast.config.choice import KIND_KEY, Chosen, choose, plain_fields
from clast.config.problems import explain, problem, refuse, short
from clast.config.sections import NeighbourSettings, WallSettings
from clast.parts.params import Params


@dataclass(frozen=True)
class WallChoice:
    """A wall: its shape, what it is made of and how it moves."""

    shape: Chosen
    material: str
    motion: Chosen | None

    @property
    def flat(self) -> bool:
        """Whether what presses on it is a component of the force on it."""
        return bool(self.shape.part.flat(self.shape.params))

    def distance(self, x: NDArray[np.float64]) -> float:
        """Return the distance in m from a point to the surface, as it stands at the start; negative behind it."""
        nearest = self.shape.part.nearest(self.shape.part.shape(self.shape.params), tuple(x.tolist()))
        return float(nearest.distance)

    def plain(self) -> dict[str, Any]:
        """Give the wall as the scene file would have it."""
        motion = {"motion": self.motion.plain()} if self.motion is not None else {}
        return {**self.shape.plain(), "material": self.material, **motion}


@dataclass(frozen=True)
class NeighbourChoice:
    """How neighbours are found: the search, and how far its lists reach beyond contact."""

    search: Chosen
    skin: float | Literal["auto"]

    def plain(self) -> dict[str, Any]:
        """Give the section as the scene file would have it."""
        return {**self.search.plain(), "skin": self.skin}


@dataclass(frozen=True)
class PartBeside:
    """Marks a field as a part with keys of Clast beside its own: ``Annotated[WallChoice, WALL]``.

    Validation needs ``context={"registry": registry}``.

    Attributes
    ----------
    kind : str
        Kind of part.
    settings : type
        The keys of Clast.
    joined : (part, **settings) -> value
        What the field becomes.
    default : str or None
        Part that is meant where no ``type`` is given.
    """

    kind: str
    settings: type[Params]
    joined: Callable[..., Any]
    default: str | None = None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Validate part and settings apart, and report the problems of both."""
        return core_schema.with_info_plain_validator_function(self._validate)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Leave a mark that :mod:`clast.config.json_schema` replaces by the registry's parts."""
        return {KIND_KEY: self.kind}

    def _validate(self, given: Any, info: ValidationInfo) -> Any:
        if isinstance(given, WallChoice | NeighbourChoice):
            return given
        written = self._mapping(given)
        own = frozenset(self.settings.model_fields)
        problems: list[InitErrorDetails] = []
        settings = part = None
        try:
            beside = {key: value for key, value in written.items() if key in own}
            settings = self.settings.model_validate(beside, context=info.context)
        except ValidationError as error:
            problems += explain(error, self.settings)
        try:
            rest = {key: value for key, value in written.items() if key not in own}
            part = choose(self.kind, rest, info, own)
        except ValidationError as error:
            problems += explain(error, self.settings)
        if settings is None or part is None:
            raise refuse(problems)
        return self.joined(part, **plain_fields(settings))

    def _mapping(self, given: Any) -> Mapping[str, Any]:
        if isinstance(given, str):
            return {"type": given}
        if not isinstance(given, Mapping):
            raise refuse([problem((), f"a mapping with 'type' is needed; given {short(given)}", given)])
        return given if self.default is None else {"type": self.default, **given}


WALL = PartBeside("wall", WallSettings, WallChoice)
NEIGHBOURS = PartBeside("neighbour_search", NeighbourSettings, NeighbourChoice, default="auto")
BESIDE = {each.kind: each for each in (WALL, NEIGHBOURS)}
"""By kind of part: the keys of Clast beside it."""
