"""YAML as users mean it: ``5e-7`` is a number, ``on`` is a word, nothing is said twice.

PyYAML follows YAML 1.1, where ``5e-7`` and ``1e6`` are texts, ``on`` and ``no`` are truth values, ``1:30`` is
90 and ``010`` is 8. Here only ``true`` and ``false`` are truth values and numbers are what they look like.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import yaml

from clast.config.document import Document
from clast.errors import ConfigError

_Base: type[yaml.SafeLoader] = getattr(yaml, "CSafeLoader", yaml.SafeLoader)

_DEEPEST = 100

_RESOLVERS: tuple[tuple[str, str, str], ...] = (
    ("tag:yaml.org,2002:null", r"~|null|Null|NULL|", "~nN\0"),
    ("tag:yaml.org,2002:bool", r"true|True|TRUE|false|False|FALSE", "tTfF"),
    ("tag:yaml.org,2002:int", r"[-+]?[0-9]+", "-+0123456789"),
    (
        "tag:yaml.org,2002:float",
        r"[-+]?(\.[0-9]+|[0-9]+\.[0-9]*|[0-9]+(?=[eE]))([eE][-+]?[0-9]+)?|[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)",
        "-+.0123456789",
    ),
    ("tag:yaml.org,2002:merge", r"<<", "<"),
)


class _Loader(_Base):  # type: ignore[misc, valid-type]
    """Safe loader with the resolvers above."""

    yaml_implicit_resolvers: dict[str, list[tuple[str, re.Pattern[str]]]] = {}  # noqa: RUF012


class _Dumper(yaml.SafeDumper):
    """Safe dumper that quotes exactly the texts the loader would take for something else."""

    yaml_implicit_resolvers: dict[str, list[tuple[str, re.Pattern[str]]]] = {}  # noqa: RUF012

    def ignore_aliases(self, data: Any) -> bool:
        """Write values that are shared out in full."""
        return True


for _tag, _pattern, _first in _RESOLVERS:
    for _class in (_Loader, _Dumper):
        _starts = ["" if letter == "\0" else letter for letter in _first]
        _class.add_implicit_resolver(_tag, re.compile(f"(?:{_pattern})$", re.ASCII), _starts)


def _construct_int(loader: yaml.SafeLoader, node: yaml.ScalarNode) -> int | float:
    try:
        return int(node.value)
    except ValueError:  # more digits than Python cares to read
        return float(node.value)


def _construct_float(loader: yaml.SafeLoader, node: yaml.ScalarNode) -> float:
    return float(node.value.lower().replace(".inf", "inf").replace(".nan", "nan"))


_Loader.add_constructor("tag:yaml.org,2002:int", _construct_int)
_Loader.add_constructor("tag:yaml.org,2002:float", _construct_float)


def read_document(path: str | Path) -> Document:
    """Read a YAML file that holds one mapping.

    Raises
    ------
    ConfigError
        The file is missing, unreadable, empty, not YAML, not a mapping, or says a key twice.
    """
    path = Path(path)
    return parse_document(_read_text(path), name=str(path), folder=path.parent)


def parse_document(text: str, name: str = "scene", folder: Path = Path()) -> Document:
    """Parse YAML text that holds one mapping; ``name`` stands for the file in messages.

    >>> parse_document("time: {step: 5e-7, end: {steps: 010}}").data
    {'time': {'step': 5e-07, 'end': {'steps': 10}}}
    """
    text = _without_control_characters(text, name)
    loader = _Loader(text)
    try:
        _refuse_deep_nesting(text, name)
        node = loader.get_single_node()
        if node is None:
            raise ConfigError(f"{name}: the file is empty; a scene is a mapping such as 'materials: ...'")
        if not isinstance(node, yaml.MappingNode):
            line, column = node.start_mark.line + 1, node.start_mark.column + 1
            raise ConfigError(f"{name}:{line}:{column}: a mapping 'key: value' is needed at the top level")
        _check_nodes(node, name, loader)
        return Document(name, folder, loader.construct_document(node), node)
    except yaml.YAMLError as error:
        raise ConfigError(_explain(error, text, name)) from None
    finally:
        loader.dispose()


def parse_value(text: str) -> Any:
    """Parse one YAML value, as in ``--set key=value``.

    >>> parse_value("1e6"), parse_value("on"), parse_value("[0, 0, 1 mm]")
    (1000000.0, 'on', [0, 0, '1 mm'])
    """
    _refuse_deep_nesting(text, "value")
    loader = _Loader(text)
    try:
        node = loader.get_single_node()
        if node is None:
            return None
        _check_nodes(node, "value", loader)
        return loader.construct_document(node)
    finally:
        loader.dispose()


def dump_yaml(data: Any) -> str:
    r"""Write plain data as YAML that :func:`read_document` reads back unchanged.

    >>> dump_yaml({"word": "1e6", "number": 1e-5})
    "word: '1e6'\nnumber: 1.0e-05\n"
    """
    return str(yaml.dump(data, Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=110))


def _read_text(path: Path) -> str:
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        raise ConfigError(f"{path}: there is no such file") from None
    except IsADirectoryError:
        raise ConfigError(f"{path}: this is a folder; a YAML file is needed") from None
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror or error}") from None
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise ConfigError(
            f"{path}:{line}: byte 0x{content[error.start]:02x} is not UTF-8 text; save the file as UTF-8"
        ) from None


def _without_control_characters(text: str, name: str) -> str:
    found = yaml.reader.Reader.NON_PRINTABLE.search(text)
    if found is None:
        return text
    line = text.count("\n", 0, found.start()) + 1
    raise ConfigError(f"{name}:{line}: the character {found.group()!r} is not allowed in YAML")


def _refuse_deep_nesting(text: str, name: str) -> None:
    """Count the nesting in the flat stream of events; composing it would overflow libyaml's stack."""
    depth = 0
    for event in yaml.parse(text, Loader=_Base):
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth > _DEEPEST:
            line = event.start_mark.line + 1 if event.start_mark is not None else 1
            raise ConfigError(f"{name}:{line}: nested more than {_DEEPEST} levels deep")


def _explain(error: yaml.YAMLError, text: str, name: str) -> str:
    mark = error.problem_mark if isinstance(error, yaml.MarkedYAMLError) else None
    if not isinstance(error, yaml.MarkedYAMLError) or mark is None:
        return f"{name}: not valid YAML: {error}"
    where = f"{name}:{mark.line + 1}:{mark.column + 1}"
    lines = text.splitlines()
    line = lines[mark.line] if mark.line < len(lines) else ""
    indentation = line[: len(line) - len(line.lstrip())]
    if "\t" in indentation or line[mark.column : mark.column + 1] == "\t":
        return f"{where}: a tab stands where YAML allows only spaces; indent with spaces"
    context = f" {error.context}" if error.context else ""
    return f"{where}: not valid YAML: {error.problem}{context}"


def _check_nodes(root: yaml.Node, name: str, loader: yaml.SafeLoader) -> None:
    """Refuse keys that are said twice or are not texts, tags of YAML, and aliases that hold themselves."""
    done: set[int] = set()
    open_nodes: set[int] = set()

    def visit(node: yaml.Node) -> None:
        if id(node) in open_nodes:
            raise ConfigError(f"{_where(node, name)}: an alias that holds itself")
        if id(node) in done:
            return
        if node.tag not in (_PLAIN[type(node)], _meant(node, loader)):
            raise ConfigError(f"{_where(node, name)}: the tag {node.tag!r} is not known here; write the value alone")
        if isinstance(node, yaml.ScalarNode):
            return
        open_nodes.add(id(node))
        if isinstance(node, yaml.MappingNode):
            _check_mapping(node, name)
        for child in _children(node):
            visit(child)
        open_nodes.remove(id(node))
        done.add(id(node))

    visit(root)


_PLAIN = {
    yaml.ScalarNode: "tag:yaml.org,2002:str",
    yaml.SequenceNode: "tag:yaml.org,2002:seq",
    yaml.MappingNode: "tag:yaml.org,2002:map",
}


def _meant(node: yaml.Node, loader: yaml.SafeLoader) -> str:
    """Return the tag that a value has by its looks."""
    return str(loader.resolve(type(node), node.value, (True, False)))  # type: ignore[no-untyped-call]


def _check_mapping(node: yaml.MappingNode, name: str) -> None:
    first: dict[str, yaml.Node] = {}
    for key, _ in node.value:
        where = _where(key, name)
        if key.tag == "tag:yaml.org,2002:merge":
            continue
        if key.tag != "tag:yaml.org,2002:str":
            written = repr(key.value) if isinstance(key, yaml.ScalarNode) else "a list or mapping"
            raise ConfigError(f"{where}: the key {written} is not a text; put it in quotes")
        if key.value in first:
            line = first[key.value].start_mark.line + 1
            raise ConfigError(f"{where}: {key.value}: said twice, first in line {line}; remove one of them")
        first[key.value] = key


def _children(node: yaml.Node) -> list[yaml.Node]:
    if isinstance(node, yaml.MappingNode):
        return [value for _, value in node.value]
    return list(node.value)


def _where(node: yaml.Node, name: str) -> str:
    return f"{name}:{node.start_mark.line + 1}:{node.start_mark.column + 1}"
