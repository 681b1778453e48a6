"""Writing a file whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Yield a temporary path beside ``path`` that takes its place on success and is deleted on failure.

    An interrupted export then never leaves half a file that looks like a result.

    Raises
    ------
    OSError
        About ``path``, if the disk refuses.
    """
    draft = path.with_name(f".{path.stem}.unfinished{path.suffix}")
    try:
        yield draft
        os.replace(draft, path)
    except OSError as error:
        if error.errno is None:
            raise
        raise OSError(error.errno, error.strerror, str(path)) from error  # the path that the user knows
    finally:
        draft.unlink(missing_ok=True)
