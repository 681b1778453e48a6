"""Descriptions of parts for ``clast plugins``: derived from their parameters' declarations."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from itertools import groupby
from typing import Any, NamedTuple

from clast.config.json_schema import model_schema
from clast.errors import PluginError
from clast.parts.params import Params
from clast.plugins.nearest import suggestion
from clast.plugins.registered import Registered, Source
from clast.plugins.registry import Registry


@dataclass(frozen=True)
class Parameter:
    """One parameter of a part, as a user needs to know it."""

    name: str
    kind: str
    default: str
    bounds: str
    meaning: str


def parameters(model: type[Params]) -> list[Parameter]:
    """List the parameters of a part; those of models inside it as ``outer.inner``."""
    schema = model_schema(model)
    return list(_parameters(schema, schema.get("$defs", {}), prefix="", depth=0))


def plugins_text(registry: Registry) -> str:
    """Table of all parts by kind, then of the plugins: which are there, blocked or broken."""
    lines: list[str] = []
    width = max((len(entry.name) for entry in registry), default=0)
    for kind, entries in groupby(registry, key=lambda entry: entry.kind):
        lines += ["", f"{kind.replace('_', ' ')}:"]
        lines += [f"  {each.name:{width}}  {each.part.summary}  [{each.source}]" for each in entries]
    plugins = plugin_states(registry)
    names = max((len(each.plugin) for each in plugins), default=0)
    sources = max((len(each.source) for each in plugins), default=0)
    lines += ["", "plugins:"]
    lines += [f"  {each.plugin:{names}}  {each.source:{sources}}  {each.told}" for each in plugins]
    return "\n".join(lines[1:]) if plugins else "no plugin is installed; install Clast with 'pip install -e .'"


class PluginState(NamedTuple):
    """A plugin and what became of it: ``ok``, ``blocked`` or ``broken``, and why."""

    plugin: str
    origin: str
    version: str
    parts: int
    state: str
    why: str = ""

    @property
    def source(self) -> str:
        """Distribution and version, or path."""
        return f"{self.origin} {self.version}".strip()

    @property
    def told(self) -> str:
        """State in words."""
        if self.state == "ok":
            return f"ok, {self.parts} part{'s' if self.parts != 1 else ''}"
        return f"{self.state}: {self.why}"


def plugin_states(registry: Registry) -> list[PluginState]:
    """Return what became of every plugin that is installed or named."""
    counts = Counter(entry.source for entry in registry)
    found = [_state(source, "ok", parts=parts) for source, parts in counts.items()]
    found += [_state(source, "blocked", "left out by CLAST_PLUGINS") for source in registry.blocked]
    found += [_state(each.source, "broken", each.reason) for each in registry.failures]
    return sorted(found)


def _state(source: Source, state: str, why: str = "", parts: int = 0) -> PluginState:
    return PluginState(source.plugin, source.origin, source.version, parts, state, why)


def plugins_data(registry: Registry) -> dict[str, Any]:
    """Return what ``clast plugins --json`` prints."""
    return {
        "parts": [part_data(entry) for entry in registry],
        "plugins": [each._asdict() for each in plugin_states(registry)],
    }


def part_data(entry: Registered) -> dict[str, Any]:
    """Return all about a part, as plain data."""
    return {
        "kind": entry.kind,
        "name": entry.name,
        "summary": entry.part.summary,
        **asdict(entry.source),
        "file": str(entry.file or ""),
        "parameters": [asdict(each) for each in parameters(entry.part.Params)],
    }


def found_parts(registry: Registry, name: str) -> list[Registered]:
    """Return the parts of one name, or of one ``kind.name``.

    Raises
    ------
    PluginError
        No part has that name.
    """
    found = [entry for entry in registry if name in (entry.name, f"{entry.kind}.{entry.name}")]
    if not found:
        raise PluginError(f"no part is named {name!r}; {suggestion(name, {entry.name for entry in registry})}")
    return found


def part_text(registry: Registry, name: str) -> str:
    """Everything about the parts of one name: summary, parameters, source.

    Raises
    ------
    PluginError
        No part has that name.
    """
    return "\n\n".join(_entry_text(entry) for entry in found_parts(registry, name))


def _entry_text(entry: Registered) -> str:
    places = (str(entry.source), str(entry.file or "file unknown"))
    lines = [
        f"{entry.name} ({entry.kind.replace('_', ' ')})",
        f"  {entry.part.summary}",
        f"  from plugin {entry.source.plugin!r} ({', '.join(dict.fromkeys(places))})",
    ]
    listed = parameters(entry.part.Params)
    if not listed:
        return "\n".join([*lines, "  no parameters"])
    rows = [("parameter", "unit or kind", "default", "bounds", "meaning")]
    rows += [(each.name, each.kind, each.default, each.bounds, each.meaning) for each in listed]
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    for row in rows:
        cells = [f"{cell:{width}}" for cell, width in zip(row, widths, strict=False)]
        lines.append("    " + "  ".join([*cells, row[4]]).rstrip())
    if entry.kind == "bond_model":
        lines.append(f"  may differ from bond to bond ('bonds.scatter'): {', '.join(_multiplied(entry.part.Params))}")
    return "\n".join(lines)


def _multiplied(model: type[Params]) -> list[str]:
    """Return the names of the parameters that are quantities: what factors can multiply."""
    fields = model_schema(model).get("properties", {})
    return [name for name, field in fields.items() if any("x-unit" in branch for branch in _branches(field))]


def _parameters(
    schema: Mapping[str, Any], definitions: Mapping[str, Any], prefix: str, depth: int
) -> Iterator[Parameter]:
    required = schema.get("required", ())
    for name, field in schema.get("properties", {}).items():
        branches = [_followed(branch, definitions) for branch in _branches(field)]
        yield Parameter(
            name=prefix + name,
            kind=" or ".join(dict.fromkeys(_kind(branch) for branch in branches)),
            default="required" if name in required else _default(field),
            bounds=", ".join(dict.fromkeys(text for branch in branches if (text := _bounds(branch)))),
            meaning=field.get("description", ""),
        )
        for branch in branches:
            inner = _followed(branch.get("items", branch), definitions)
            if "properties" in inner and depth < 3:
                yield from _parameters(inner, definitions, f"{prefix}{name}.", depth + 1)


def _branches(field: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    return list(field.get("anyOf") or field.get("oneOf") or [field])


def _followed(schema: Mapping[str, Any], definitions: Mapping[str, Any]) -> Mapping[str, Any]:
    if "$ref" not in schema:
        return schema
    target = definitions.get(str(schema["$ref"]).removeprefix("#/$defs/"), {})
    return {**target, **{key: value for key, value in schema.items() if key != "$ref"}}


def _kind(schema: Mapping[str, Any]) -> str:
    if "x-unit" in schema:
        return "number" if schema["x-unit"] == "1" else str(schema["x-unit"])
    if "enum" in schema or "const" in schema:
        return " | ".join(str(each) for each in schema.get("enum", [schema.get("const")]))
    if "prefixItems" in schema:
        return "[" + ", ".join(_kind(each) for each in schema["prefixItems"]) + "]"
    if schema.get("type") == "array":
        return "list"
    words = {"string": "text", "boolean": "true | false", "object": "mapping", "null": "none"}
    kind = str(schema.get("type", "anything"))
    return words.get(kind, kind)


def _default(field: Mapping[str, Any]) -> str:
    default = field.get("default")
    if default is None:
        return "none"
    if isinstance(default, bool):
        return str(default).lower()
    return f"{default:g}" if isinstance(default, float) else str(default)


def _bounds(schema: Mapping[str, Any]) -> str:
    signs = {"exclusiveMinimum": ">", "minimum": "≥", "exclusiveMaximum": "<", "maximum": "≤"}
    return ", ".join(f"{sign} {schema[key]:g}" for key, sign in signs.items() if key in schema)
