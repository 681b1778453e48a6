"""Column: an HDF5 dataset that grows in large pieces."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.results.room import SPARE, room_beyond

_HELD_BYTES = 1 << 20
_CHUNK_ROWS = 1 << 16


class Column:
    """A compressed dataset that grows along its first axis, written a megabyte at a time.

    Parameters
    ----------
    group : h5py.Group
        Where the dataset is made.
    name : str
        Its name there; may hold slashes.
    """

    def __init__(self, group: Any, name: str) -> None:
        self._group = group
        self._name = name
        self._held: list[NDArray[Any]] = []
        self._length = 0
        self._last: tuple[int, NDArray[Any]] | None = None

    def append(self, values: NDArray[Any]) -> int:
        """Append rows and return the number of the first one."""
        start = self._length
        self._held.append(values)
        self._length += len(values)
        if sum(block.nbytes for block in self._held) > _HELD_BYTES:
            self.flush()
        return start

    def append_if_new(self, values: NDArray[Any]) -> int:
        """Append rows unless they equal the ones given last; return where they start."""
        if self._last is None or not np.array_equal(self._last[1], values):
            self._last = (self.append(values), values)
        return self._last[0]

    def flush(self) -> None:
        """Write the rows held back."""
        if not self._held:
            return
        rows = np.concatenate(self._held)
        # the chunks begun before and now are written whole; what cannot be compressed grows by less than a hundredth
        chunk = math.prod(rows.shape[1:]) * rows.itemsize * self._chunk_rows(rows)
        with room_beyond(self._group.file, SPARE + (rows.nbytes + 2 * chunk) * 101 // 100):
            if self._name not in self._group:
                self._create(rows)
            dataset = self._group[self._name]
            dataset.resize(self._length, axis=0)
            if len(rows):
                dataset[self._length - len(rows) :] = rows
        self._held = []

    def _chunk_rows(self, rows: NDArray[Any]) -> int:
        known = self._group.get(self._name)
        return min(max(len(rows), 1), _CHUNK_ROWS) if known is None else int(known.chunks[0])

    def _create(self, rows: NDArray[Any]) -> None:
        # gzip and shuffle are the only filters that VTK reads
        self._group.create_dataset(
            self._name,
            (0, *rows.shape[1:]),
            maxshape=(None, *rows.shape[1:]),
            chunks=(self._chunk_rows(rows), *rows.shape[1:]),
            dtype=rows.dtype,
            compression="gzip",
            compression_opts=1,
            shuffle=True,
        )
