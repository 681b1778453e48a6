"""JSON Schema of scene files, for editors: the models of the sections plus every registered part."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel

from clast.config.beside import BESIDE
from clast.config.choice import KIND_KEY
from clast.config.scene import SceneConfig
from clast.plugins.registered import Registered
from clast.plugins.registry import KINDS, Registry

Schema = dict[str, Any]

_BOUNDS = {"gt": "exclusiveMinimum", "ge": "minimum", "lt": "exclusiveMaximum", "le": "maximum"}
_REFERENCE = "#/$defs/{model}"


def scene_schema(registry: Registry) -> Schema:
    """JSON Schema (draft 2020-12) of a scene made of the registry's parts.

    Quantities carry their SI unit as ``x-unit``. Bounds hold for plain numbers; texts with a unit are checked
    by Clast itself.
    """
    schema = model_schema(SceneConfig)
    definitions = schema.pop("$defs", {})
    for kind in KINDS:
        definitions[f"any {kind}"] = _choice(registry, kind, definitions)
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema"}
    whole = _linked(
        {
            **head,
            **schema,
            "title": "Clast scene",
            "description": _docstring_start(SceneConfig),
            "$defs": definitions,
        }
    )
    assert isinstance(whole, dict)
    return whole


def model_schema(model: type[BaseModel]) -> Schema:
    """JSON Schema of one model, bounds of quantities under their standard names."""
    schema = _standard_bounds(model.model_json_schema(ref_template=_REFERENCE))
    assert isinstance(schema, dict)
    return schema


def _choice(registry: Registry, kind: str, definitions: Schema) -> Schema:
    """Either the bare name of a part that needs no parameters, or a mapping with ``type``."""
    entries = [registry.get(kind, name) for name in registry.names(kind)]
    branches: list[Schema] = []
    for entry in entries:
        name = f"{kind} {entry.name}"
        definitions[name] = _part(entry, definitions)
        branches.append({"$ref": _reference(name)})
    bare = [entry.name for entry in entries if not _needs_something(entry)]
    if bare:
        branches.insert(0, {"enum": bare})
    return {"oneOf": branches} if branches else {"not": {}}


def _part(entry: Registered, definitions: Schema) -> Schema:
    schema = _own_schema(entry, definitions)
    properties = {"type": {"const": entry.name, "description": entry.part.summary}}
    required = ["type"]
    beside = BESIDE.get(entry.kind)
    if beside is not None:
        settings = model_schema(beside.settings)
        properties |= settings["properties"]
        required = [*([] if entry.name == beside.default else required), *settings.get("required", [])]
    schema["properties"] = properties | schema.get("properties", {})
    schema["required"] = required + schema.get("required", [])
    schema["title"] = entry.name
    schema.setdefault("description", entry.part.summary)
    return schema


def _own_schema(entry: Registered, definitions: Schema) -> Schema:
    """Describe a part's parameters; the models inside them move to ``definitions`` under their own names."""
    schema = model_schema(entry.part.Params)
    inner = schema.pop("$defs", {})
    renamed = {_reference(name): _reference(f"{entry.kind} {entry.name} {name}") for name in inner}
    for name, definition in inner.items():
        definitions[f"{entry.kind} {entry.name} {name}"] = _renamed(definition, renamed)
    own = _renamed(schema, renamed)
    assert isinstance(own, dict)
    return own


def _docstring_start(model: type[BaseModel]) -> str:
    return (model.__doc__ or "").split("\n", 1)[0]


def _needs_something(entry: Registered) -> bool:
    models = [entry.part.Params, *([BESIDE[entry.kind].settings] if entry.kind in BESIDE else [])]
    return any(field.is_required() for model in models for field in model.model_fields.values())


def _reference(name: str) -> str:
    return "#/$defs/" + name.replace(" ", "%20")


def _linked(value: Any) -> Any:
    """Replace the marks of part fields by references to the parts of their kind."""
    if isinstance(value, Mapping):
        linked = {key: _linked(inner) for key, inner in value.items() if key != KIND_KEY}
        if KIND_KEY in value:
            linked["$ref"] = _reference(f"any {value[KIND_KEY]}")
        if linked.get("default", 0) is None:
            del linked["default"]
        return linked
    return [_linked(inner) for inner in value] if isinstance(value, list) else value


def _standard_bounds(value: Any) -> Any:
    if isinstance(value, Mapping):
        names = _BOUNDS if "x-unit" in value else {}
        return {names.get(key, key): _standard_bounds(inner) for key, inner in value.items()}
    return [_standard_bounds(inner) for inner in value] if isinstance(value, list) else value


def _renamed(value: Any, names: Mapping[str, str]) -> Any:
    if isinstance(value, Mapping):
        return {
            key: names.get(inner, inner) if key == "$ref" else _renamed(inner, names) for key, inner in value.items()
        }
    return [_renamed(inner, names) for inner in value] if isinstance(value, list) else value
