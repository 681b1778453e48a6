"""Parts whose own keys stand beside keys of Clast, such as a wall's shape beside its material."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationError, ValidationInfo
from pydantic_core import CoreSchema, InitErrorDetails, core_schema

from clast.config.choice import KIND_KEY, choose, plain_fields
from clast.config.problems import explain, problem, refuse, short
from clast.parts.params import Params


class Joined(ABC):
    """What a part and the keys of Clast beside it become."""

    @abstractmethod
    def plain(self) -> dict[str, Any]:
        """Give the whole as the scene file would have it."""


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
        if isinstance(given, Joined):
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
