"""Records with lists of numbers, such as the rows of a measured course: the lists of all walls lie in one array.

Of a list the row of a record keeps where it begins and ends; the law sees it as an array.
"""

from __future__ import annotations

from itertools import count
from typing import Any

import numpy as np

from clast.engine.records import LONG, construct_from_fields, is_record, members


def construct_long(record: type, name: str) -> str:
    """Return the expression that builds a record, known as ``name``, from its ``row`` and the ``lists``.

    >>> from typing import NamedTuple
    >>> from numpy.typing import NDArray
    >>> Course = NamedTuple("Course", [("way", tuple[float, float]), ("times", NDArray[np.float64])])
    >>> construct_long(Course, "Course")
    'Course((row[0], row[1],), lists[int(row[2]) : int(row[3])])'
    """
    at = count()

    def take(size: int) -> str:
        if size == LONG:
            return f"lists[int(row[{next(at)}]) : int(row[{next(at)}])]"
        return f"row[{next(at)}]" if size == 1 else f"({', '.join(f'row[{next(at)}]' for _ in range(size))},)"

    return construct_from_fields(record, name, take)


def long_row(record: Any, lists: list[float]) -> list[float]:
    """Return the numbers of a record in a row, and append its lists to those of all."""
    row: list[float] = []
    kind: type = type(record)
    for value, member in zip(record, members(kind).values(), strict=True):
        if is_record(value):
            row += long_row(value, lists)
        elif member == LONG:
            begin = len(lists)
            lists += np.asarray(value, float).tolist()
            row += [float(begin), float(len(lists))]
        else:
            row += np.asarray(value, float).ravel().tolist()
    return row
