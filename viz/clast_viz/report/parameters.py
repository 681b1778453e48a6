"""Parameters: a resolved config as rows of a table, and where the configs of several runs differ."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

MOST_ENTRIES = 12
"""Of a list whose entries get rows of their own."""
UNSAID = ("name", "description", "reference", "output.writers")
"""Keys that differ, or whose keys do, without making a difference to what is computed."""
EMPTY: tuple[Any, ...] = ("", [], {})
"""Values that are not worth a row."""
MISSING = "–"


class Row(NamedTuple):
    """A key and what each run has there."""

    key: str
    values: list[str]


def sections(config: Mapping[str, Any]) -> dict[str, list[Row]]:
    """Return the rows of a config by its top-level sections, without empty ones; keys as ``--set`` takes them."""
    below = {str(key): _leaves(value, str(key)) for key, value in config.items()}
    said = {key: [leaf for leaf in leaves if leaf[1] not in EMPTY] for key, leaves in below.items()}
    return {key: [Row(path, [text_of(value)]) for path, value in leaves] for key, leaves in said.items() if leaves}


def differences(configs: Sequence[Mapping[str, Any]]) -> list[Row]:
    """Return the keys in which configs differ, with the value of each run.

    >>> differences([{"time": {"step": 1e-6}, "seed": 1}, {"time": {"step": 1e-6}, "seed": 2}])
    [Row(key='seed', values=['1', '2'])]
    """
    tables = [dict(leaf for key, value in config.items() for leaf in _leaves(value, str(key))) for config in configs]
    keys = [key for key in dict.fromkeys(key for table in tables for key in table) if not _unsaid(key)]
    differing = [key for key in keys if any(key not in table or table[key] != tables[0].get(key) for table in tables)]
    return [Row(key, [text_of(table[key]) if key in table else MISSING for table in tables]) for key in differing]


def _unsaid(key: str) -> bool:
    return any(f"{key}.".startswith(f"{each}.") for each in UNSAID)


def _leaves(value: Any, path: str) -> Iterator[tuple[str, Any]]:
    """Yield every value below a key; lists of numbers, and long lists, are values themselves."""
    if isinstance(value, Mapping) and value:
        for key, below in value.items():
            yield from _leaves(below, f"{path}.{key}")
    elif isinstance(value, list) and 0 < len(value) <= MOST_ENTRIES and isinstance(value[0], Mapping):
        for k, below in enumerate(value):
            yield from _leaves(below, f"{path}.{k}")
    else:
        yield path, value


def text_of(value: Any) -> str:
    """Return a value as a reader of YAML would write it.

    >>> text_of([0.0, -0.00108, 420000000.0]), text_of(None), text_of(True)
    ('[0, -0.00108, 4.2e8]', 'none', 'true')
    """
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, list):
        many = len(value) > MOST_ENTRIES
        return f"{len(value):,} entries" if many else f"[{', '.join(text_of(each) for each in value)}]"
    return str(value) if value != {} else "{}"


def _number(value: float) -> str:
    """Return a float to 12 digits; very large and very small ones as a power of ten."""
    if value == 0.0 or 1e-4 <= abs(value) < 1e6:
        return f"{value:.12g}"
    mantissa, _, exponent = f"{value:.11e}".partition("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}" if exponent else mantissa
