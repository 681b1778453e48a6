"""Document: the data of a scene file, and the line of every key."""

from __future__ import annotations

import copy
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import yaml

from clast.errors import ConfigError, KeyPath
from clast.plugins.nearest import suggestion


def dotted(path: KeyPath) -> str:
    """Key path as users write it: ``particles.0.seed``."""
    return ".".join(str(step) for step in path)


@dataclass(frozen=True)
class Problem:
    """Something wrong at a key path; ``kind`` is empty, or one of those in :mod:`clast.config.problems`."""

    path: KeyPath
    message: str
    kind: str = ""


@dataclass(frozen=True)
class Document:
    """Data as written, and where each piece of it stands.

    Attributes
    ----------
    name : str
        What stands for the file in messages.
    folder : Path
        Where relative paths in the scene start: the folder of the file.
    data : dict
        The scene as written, units not yet read.
    node : yaml.Node or None
        Root of the parsed file, for lines and columns.
    overridden : mapping
        Key path -> the override that set it, as the user wrote it.
    """

    name: str
    folder: Path
    data: dict[str, Any]
    node: yaml.Node | None = None
    overridden: Mapping[KeyPath, str] = field(default_factory=dict)

    def get(self, path: KeyPath) -> Any:
        """Value at a key path; KeyError where there is none."""
        value: Any = self.data
        for step in path:
            value = _descend(value, step)
        return value

    def has(self, path: KeyPath) -> bool:
        """Whether something is written at a key path."""
        try:
            self.get(path)
        except KeyError:
            return False
        return True

    def line_and_column(self, path: KeyPath) -> tuple[int, int]:
        """Where the key of a path stands, or the nearest one above it; (0, 0) without a file."""
        if self.node is None:
            return (0, 0)
        key = node = self.node
        for step in path:
            found = _key_and_value(node, step)
            if found is None:
                break
            key, node = found
        return (key.start_mark.line + 1, key.start_mark.column + 1)

    def where(self, path: KeyPath) -> str:
        """Say what a message begins with: ``scene.yaml:3:3``, or the override's own text."""
        for length in range(len(path), 0, -1):
            if path[:length] in self.overridden:
                return self.overridden[path[:length]]
        line, column = self.line_and_column(path)
        return f"{self.name}:{line}:{column}" if line else self.name

    def report(self, problems: Iterable[Problem]) -> str:
        """All problems in the order of the file, one a line."""
        ordered = sorted(set(problems), key=lambda each: (self.line_and_column(each.path), dotted(each.path)))
        lines = []
        for problem in ordered:
            key = f"{dotted(problem.path)}: " if problem.path else ""
            lines.append(f"{self.where(problem.path)}: {key}{problem.message}")
        return "\n".join(lines)

    def changed(self, path: KeyPath, value: Any, written: str, closed: Collection[KeyPath] = ()) -> Document:
        """Copy with one value replaced or added; mappings above it are added where they are missing.

        Parameters
        ----------
        path : key path
        value : anything
        written : str
            How messages name this change.
        closed : collection of key paths
            Mappings below which nothing is added: their keys are names that the user chose.

        Raises
        ------
        ConfigError
            What stands above the value is no mapping or list, is a list with fewer entries, or a closed mapping
            without this key.
        """
        added: list[KeyPath] = []
        data = copy.deepcopy(self.data)
        parent: Any = data
        for depth, step in enumerate(path[:-1]):
            if isinstance(parent, dict) and step not in parent and path[:depth] not in closed:
                parent[str(step)] = {}
                added.append(path[: depth + 1])
            path = _numbered(path, depth, parent)
            parent = _parent(parent, step, path[:depth], written)
        path = _numbered(path, len(path) - 1, parent)
        _put(parent, path, value, written)
        kept = {each: text for each, text in self.overridden.items() if each[: len(path)] != path}
        return replace(self, data=data, overridden=kept | dict.fromkeys([*added, path], written))


def _descend(value: Any, step: str | int) -> Any:
    if isinstance(value, Mapping) and step in value:
        return value[step]
    if isinstance(value, list | tuple):
        index = _index(step)
        if index is not None and index < len(value):
            return value[index]
    raise KeyError(step)


def _numbered(path: KeyPath, depth: int, parent: Any) -> KeyPath:
    """Path in which a step into a list is a number, as validation errors have it."""
    index = _index(path[depth])
    if isinstance(parent, list) and index is not None:
        return (*path[:depth], index, *path[depth + 1 :])
    return path


def _index(step: str | int) -> int | None:
    if isinstance(step, int):
        return step if step >= 0 else None
    return int(step) if step.isascii() and step.isdigit() else None


def _key_and_value(node: yaml.Node, step: str | int) -> tuple[yaml.Node, yaml.Node] | None:
    if isinstance(node, yaml.MappingNode):
        return _in_mapping(node, str(step))
    if isinstance(node, yaml.SequenceNode):
        index = _index(step)
        if index is not None and index < len(node.value):
            return node.value[index], node.value[index]
    return None


def _in_mapping(node: yaml.MappingNode, name: str) -> tuple[yaml.Node, yaml.Node] | None:
    for key, value in node.value:
        if key.value == name:
            return key, value
    for key, value in node.value:
        if key.tag == "tag:yaml.org,2002:merge":
            for merged in value.value if isinstance(value, yaml.SequenceNode) else [value]:
                found = _key_and_value(merged, name)
                if found is not None:
                    return found
    return None


def _parent(value: Any, step: str | int, above: KeyPath, written: str) -> Any:
    try:
        found = _descend(value, step)
    except KeyError:
        raise ConfigError(f"{written}: {_absent(value, step, above)}") from None
    if not isinstance(found, dict | list):
        key = dotted((*above, step))
        whole = f"{key}={{type: {found}, ...}}" if isinstance(found, str) else f"{key}=..."
        raise ConfigError(f"{written}: {key} is {found!r}, which has no keys to set; give it whole: {whole}")
    return found


def _absent(value: Any, step: str | int, above: KeyPath) -> str:
    inside = dotted(above) or "the scene"
    if isinstance(value, list):
        return f"{inside} has {len(value)} entries, counted from 0; there is no entry {step}"
    return f"{inside} has no key {str(step)!r}; {suggestion(str(step), value)}"


def _put(parent: Any, path: KeyPath, value: Any, written: str) -> None:
    step = path[-1]
    if isinstance(parent, dict):
        parent[str(step)] = value
        return
    index = _index(step)
    if index is None or index >= len(parent):
        raise ConfigError(f"{written}: {_absent(parent, step, path[:-1])}")
    parent[index] = value
