"""How the records of laws lie in tables: floats take one slot, vectors three, quaternions four.

A record may hold others: their numbers lie where they stand, and their fields are named ``outer.inner``. Records of
walls may hold lists of numbers too: see :mod:`clast.engine.long_records`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from types import UnionType
from typing import Any, NamedTuple, Union, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray

from clast.errors import PluginError

LONG = 0
"""Size of a field that holds as many numbers as a wall needs."""


class Field(NamedTuple):
    """One field of a record: its name and how many numbers it takes."""

    name: str
    size: int


@cache
def members(record: type) -> dict[str, int | type]:
    """Return what the fields of a NamedTuple type are by name: so many numbers (``LONG``: any), or another record.

    Raises
    ------
    PluginError
        If the type is no NamedTuple, or a field is none of: number, fixed tuple of floats, array, NamedTuple.
    """
    if not is_record(record):
        raise PluginError(f"{record.__module__}.{record.__qualname__} must be a NamedTuple")
    hints = get_type_hints(record)
    names = record._fields  # type: ignore[attr-defined]
    return {name: hints[name] if is_record(hints[name]) else _size(record, name, hints[name]) for name in names}


def is_record(value: Any) -> bool:
    """Return whether a type is a NamedTuple, or a value is one of such a type."""
    return hasattr(value, "_fields")


def fields(record: type | None) -> list[Field]:
    """Return the fields of a NamedTuple type, those of records inside it in their place.

    Raises
    ------
    PluginError
        If the record cannot be kept; see :func:`members`.

    Examples
    --------
    >>> class State(NamedTuple):
    ...     strain: float
    ...     slip: tuple[float, float, float]
    >>> fields(State)
    [Field(name='strain', size=1), Field(name='slip', size=3)]
    """
    found: list[Field] = []
    if record is None:
        return found
    for name, member in members(record).items():
        if member == LONG:
            raise PluginError(f"{record.__module__}.{record.__qualname__}.{name}: only records of walls hold arrays")
        if isinstance(member, int):
            found.append(Field(name, member))
        else:
            found += [Field(f"{name}.{inner}", size) for inner, size in fields(member)]
    return found


def leaves(record: Any) -> list[Any]:
    """Return the values of a record, those of records inside it in their place."""
    return [leaf for value in record for leaf in (leaves(value) if is_record(value) else [value])]


def _size(record: type, name: str, hint: Any) -> int:
    arguments = get_args(hint)
    if hint in (float, int) or (get_origin(hint) in (Union, UnionType) and float in arguments):
        return 1
    if get_origin(hint) is np.ndarray:
        return LONG
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

    A record in the field ``inner`` is known as ``name_inner``.

    >>> class State(NamedTuple):
    ...     strain: float
    ...     slip: tuple[float, float, float]
    >>> construct(State, "State", ["a", "b", "c", "d"])
    'State(a, (b, c, d,))'
    """
    texts = iter(values)

    def take(size: int) -> str:
        return next(texts) if size == 1 else f"({', '.join(next(texts) for _ in range(size))},)"

    return construct_from_fields(record, name, take)


def construct_from_fields(record: type, name: str, take: Callable[[int], str]) -> str:
    """Return the expression that builds a record from the text of each field, ``take(size)``, in their order."""
    return str(_fold(record, name, take, lambda _, known_as, parts: f"{known_as}({', '.join(parts)})"))


def build(record: type, values: Iterable[float]) -> Any:
    """Return a record of its numbers in a row.

    >>> class State(NamedTuple):
    ...     strain: float
    ...     slip: tuple[float, float, float]
    >>> build(State, [1.0, 2.0, 3.0, 4.0])
    State(strain=1.0, slip=(2.0, 3.0, 4.0))
    """
    row = iter(values)

    def take(size: int) -> float | tuple[float, ...]:
        return next(row) if size == 1 else tuple(next(row) for _ in range(size))

    return _fold(record, "", take, lambda kind, _, parts: kind(*parts))


def _fold(record: type, name: str, take: Callable[[int], Any], whole: Callable[[type, str, list[Any]], Any]) -> Any:
    parts = [
        take(member) if isinstance(member, int) else _fold(member, f"{name}_{field}", take, whole)
        for field, member in members(record).items()
    ]
    return whole(record, name, parts)


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
        _column(value, field, count, type(record))
        for field, value in zip(fields(type(record)), leaves(record), strict=True)
    ]
    return np.concatenate(table, axis=1) if table else np.zeros((count, 0))


def _column(value: Any, field: Field, count: int, record: type) -> NDArray[np.float64]:
    rows = np.asarray(value, np.float64).reshape(-1, field.size)
    if len(rows) not in (1, count):
        raise PluginError(
            f"{record.__module__}.{record.__qualname__}.{field.name} has {len(rows)} entries; {count} are needed, one "
            "each, or one for all"
        )
    return np.broadcast_to(rows, (count, field.size))


def from_columns(record: type, table: NDArray[np.float64]) -> Any:
    """Return a record of arrays from a (count, width) table, as :func:`columns` makes it; equal rows become one number.

    >>> class State(NamedTuple):
    ...     strain: float
    ...     slip: tuple[float, float, float]
    >>> from_columns(State, np.array([[1.0, 2.0, 3.0, 4.0], [5.0, 2.0, 3.0, 4.0]]))
    State(strain=array([1., 5.]), slip=array([2., 3., 4.]))
    """
    row = iter(table.T)

    def take(size: int) -> NDArray[np.float64]:
        each = next(row) if size == 1 else np.column_stack([next(row) for _ in range(size)])
        return np.asarray(each[0]) if (each == each[0]).all() else each

    return _fold(record, "", take, lambda kind, _, parts: kind(*parts))


def numbers(record: Any) -> list[float]:
    """Return the numbers of one record in a row."""
    return [float(x) for x in columns(record, 1)[0]]
