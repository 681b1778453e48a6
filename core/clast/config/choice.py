"""Choice of a part: ``model: {type: elastic, ...}`` becomes a part with its validated parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationError, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from clast.config.problems import MISSING, UNKNOWN_PART, explain, problem, refuse, short
from clast.errors import PluginError
from clast.parts.params import Params
from clast.plugins.registered import Source
from clast.plugins.registry import Registry

KIND_KEY = "x-clast-kind"


@dataclass(frozen=True)
class Chosen:
    """A part a scene has chosen.

    Attributes
    ----------
    kind, name : str
        Kind of the part and its name in the registry.
    part : object
        What the plugin registered, for instance a :class:`clast.parts.bond_model.BondModel`, or its variant for
        these parameters.
    params : Params
        An instance of ``part.Params``, in SI.
    source : Source
        Plugin that brought the part.
    """

    kind: str
    name: str
    part: Any
    params: Params
    source: Source

    def plain(self) -> dict[str, Any]:
        """Give ``type`` and parameters as the scene file would have them."""
        return {"type": self.name, **plain_fields(self.params)}


def plain_fields(model: Params) -> dict[str, Any]:
    """Fields of a model by name, values untouched."""
    return {name: getattr(model, name) for name in type(model).model_fields}


def choose(kind: str, given: Any, info: ValidationInfo, also: frozenset[str] = frozenset()) -> Chosen:
    """Turn a name, or a mapping with ``type``, into a chosen part.

    Parameters
    ----------
    kind : str
        Kind of part.
    given : str or mapping
        A bare name stands for a part with all its defaults.
    info : ValidationInfo
        Its context holds the registry, and the folder where relative paths start.
    also : frozenset of str
        Keys known to stand beside the part's own; only for the suggestions of messages.

    Raises
    ------
    ValidationError
        No such part, or its parameters are wrong.
    """
    if isinstance(given, Chosen):
        return given
    registry = registry_of(info)
    name, rest = _name_and_rest(kind, given, registry)
    try:
        entry = registry.get(kind, name)
    except PluginError as error:
        raise refuse([problem(("type",), str(error), name, UNKNOWN_PART)]) from None
    try:
        params = entry.part.Params.model_validate(rest, context=info.context)
    except ValidationError as error:
        raise refuse(explain(error, entry.part.Params, also | {"type"})) from None
    return Chosen(kind, name, entry.part_for(params), params, entry.source)


def _name_and_rest(kind: str, given: Any, registry: Registry) -> tuple[str, dict[str, Any]]:
    known = f"known are {', '.join(registry.names(kind)) or 'none'}"
    if isinstance(given, str):
        return given, {}
    if not isinstance(given, Mapping):
        needed = f"the name of a {kind.replace('_', ' ')} is needed, or a mapping with 'type'; {known}"
        raise refuse([problem((), f"{needed}; given {short(given)}", given)])
    if "type" not in given:
        text = f"this key is missing: which {kind.replace('_', ' ')}; {known}"
        raise refuse([problem(("type",), text, kind=MISSING)])
    name = given["type"]
    if not isinstance(name, str):
        raise refuse([problem(("type",), f"{name!r} is not a name; {known}", name)])
    return name, {key: value for key, value in given.items() if key != "type"}


@dataclass(frozen=True)
class PartOf:
    """Marks a field as the choice of a part: ``Annotated[Chosen, PartOf("integrator")]``.

    Validation needs ``context={"registry": registry}``.
    """

    kind: str

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Validate by looking the part up."""

        def validate(given: Any, info: ValidationInfo) -> Chosen:
            return choose(self.kind, given, info)

        return core_schema.with_info_plain_validator_function(validate)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """Leave a mark that :mod:`clast.config.json_schema` replaces by the registry's parts."""
        return {KIND_KEY: self.kind}


def default_part(name: str | None) -> Any:
    """Default of a :class:`PartOf` field: a name, which becomes a part when the scene is validated."""
    return name


def registry_of(info: ValidationInfo) -> Registry:
    """Registry a validation was given."""
    registry = (info.context or {}).get("registry")
    if not isinstance(registry, Registry):
        raise TypeError("validating a scene needs context={'registry': ...}; use clast.load")
    return registry
