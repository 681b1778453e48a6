"""Room on the disk, taken before HDF5 writes: it cannot close a file in good order once a write of its own failed."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

BLOCK = 2**20
SPARE = 2**16
"""Bytes by which headers and indices of a file may grow between two flushes."""


class NoRoomError(OSError):
    """The disk, a quota or a limit refuses to let a file grow."""


def in_memory(fill: Callable[[Any], object], **options: Any) -> bytes:
    """Return an HDF5 file as bytes, for writing whole.

    Parameters
    ----------
    fill : (h5py.File) -> object
        Writes what it holds.
    **options
        For ``h5py.File``.
    """
    import h5py

    with h5py.File("in memory", "w", driver="core", backing_store=False, **options) as file:
        fill(file)
        file.flush()
        return bytes(file.id.get_file_image())


@contextmanager
def room_beyond(file: Any, most: int) -> Iterator[None]:
    """Hold room beyond the end of an open HDF5 file while it grows, and give back what was not needed.

    Parameters
    ----------
    file : h5py.File
        Open for writing, with nothing unwritten in it.
    most : int
        Bytes by which the file may grow.

    Raises
    ------
    NoRoomError
        The file is as it was, and may be closed.
    """
    handle, end = file.id.get_vfd_handle(), file.id.get_filesize()
    try:
        _take(handle, end, most)
    except OSError as error:
        os.ftruncate(handle, end)
        raise NoRoomError(error.errno, error.strerror) from error
    yield
    file.flush()
    os.ftruncate(handle, file.id.get_filesize())


def _take(handle: int, start: int, count: int) -> None:
    if hasattr(os, "posix_fallocate"):
        os.posix_fallocate(handle, start, count)
        return
    while count > 0:  # macOS knows no such call
        taken = os.pwrite(handle, bytes(min(count, BLOCK)), start)
        start, count = start + taken, count - taken
