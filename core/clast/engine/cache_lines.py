"""Tables that begin on a cache line: a row of eight numbers then fills one line, and a vector of eight is read at once.

Where numpy's arrays begin differs from one start of the program to the next, and with it the time of a step.
"""

from __future__ import annotations

import math
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

LINE, PAGE = 64, 4096
APART = 10 * LINE
Record = TypeVar("Record", bound=tuple[Any, ...])


def on_lines(record: Record) -> Record:
    """Return a record of arrays with copies that begin on cache lines, each at another place of its page.

    The same row of all tables would otherwise fall into one set of the cache, which holds eight lines.
    """
    return type(record)(*(on_line(array, k * APART) for k, array in enumerate(record)))


def on_line(array: NDArray[Any], place: int = 0) -> NDArray[Any]:
    """Return a copy of an array that begins so many bytes into a page.

    >>> on_line(np.arange(3.0), LINE).ctypes.data % PAGE
    64
    """
    copy = room_on_line(array.shape, array.dtype, place)
    copy[...] = array
    return copy


def room_on_line(shape: tuple[int, ...], dtype: np.dtype[Any], place: int = 0) -> NDArray[Any]:
    """Return an array that begins so many bytes into a page, and holds anything."""
    size = math.prod(shape) * dtype.itemsize
    room = np.empty(size + PAGE, np.uint8)
    first = (place - room.ctypes.data) % PAGE
    return room[first : first + size].view(dtype).reshape(shape)
