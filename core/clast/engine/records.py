"""How the records of laws lie in tables: floats take one slot, vectors three, quaternions four."""

from __future__ import annotations

from collections.abc import Iterable
from types import UnionType
from typing import Any, NamedTuple, Union, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from clast.errors import PluginError


class Field(NamedTuple):
    """One field of a record: its name and how many numbers it takes."""

    name: str
    size: int


def fields(record: type | None) -> list[Field]:
    """Return the fields of a NamedTuple type.

    Raises
    ------
    PluginError
        If the type is no NamedTuple, or a field is neither a number nor a fixed tuple of floats.

    Examples
    --------
    >>> class State(NamedTuple):
    ...     strain: float
    ...     slip: tuple[float, float, float]
    >>> fields(State)
    [Field(name='strain', size=1), Field(name='slip', size=3)]
    """
    if record is None:
        return []
    if not hasattr(record, "_fields"):
        raise PluginError(f"{record.__module__}.{record.__qualname__} must be a NamedTuple")
    hints = get_type_hints(record)
    return [Field(name, _size(record, name, hints[name])) for name in record._fields]


def _size(record: type, name: str, hint: Any) -> int:
    arguments = get_args(hint)
    if hint in (float, int) or (get_origin(hint) in (Union, UnionType) and float in arguments):
        return 1
    if get_origin(hint) is tuple and all(argument is float for argument in arguments):
        return len(arguments)
    raise PluginError(
        f"{record.__module__}.{record.__qualname__}.{name}: {hint} cannot be kept in the compiled loop; "
        "use float or Vec"
    )


def width(record: type | None) -> int:
    """Return how many numbers a record takes."""
    return sum(field.size for field in fields(record))


def construct(record: type, name: str, values: Iterable[str]) -> str:
    """Return the expression that builds a record, known as ``name``, from one text per number.

    >>> class State(NamedTuple):
    ...     strain: float
    ...     slip: tuple[float, float, float]
    >>> construct(State, "State", ["a", "b", "c", "d"])
    'State(a, (b, c, d,))'
    """
    texts = iter(values)
    parts = []
    for field in fields(record):
        own = [next(texts) for _ in range(field.size)]
        parts.append(own[0] if field.size == 1 else f"({', '.join(own)},)")
    return f"{name}({', '.join(parts)})"


def destruct(record: type, variable: str) -> list[str]:
    """Return one expression per number of a record.

    >>> class State(NamedTuple):
    ...     strain: float
    ...     slip: tuple[float, float, float]
    >>> destruct(State, "s")
    ['s.strain', 's.slip[0]', 's.slip[1]', 's.slip[2]']
    """
    texts = []
    for field in fields(record):
        name = f"{variable}.{field.name}"
        texts += [name] if field.size == 1 else [f"{name}[{k}]" for k in range(field.size)]
    return texts


def columns(record: Any, count: int) -> NDArray[np.float64]:
    """Return the (count, width) table of a record whose fields are numbers, vectors, or arrays of them."""
    table = [
        np.broadcast_to(np.asarray(value, np.float64).reshape(-1, field.size), (count, field.size))
        for field, value in zip(fields(type(record)), record, strict=True)
    ]
    return np.concatenate(table, axis=1) if table else np.zeros((count, 0))


def numbers(record: Any) -> list[float]:
    """Return the numbers of one record in a row."""
    return [float(x) for x in columns(record, 1)[0]]
