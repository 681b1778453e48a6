"""Names that a user gives: they become folders, keys of files, and columns of tables."""

from __future__ import annotations

import re
from typing import Annotated

from pydantic import AfterValidator

_KEY = re.compile(r"\w[\w-]*( [\w-]+)*")
MOST_BYTES = 200
"""Of a scene's name; file systems take 255, and a number may come behind it."""


def key_name(name: str) -> str:
    """Return a name that can stand in paths of results, columns of curves and keys of ``--set``.

    Raises
    ------
    ValueError
        With what is allowed.

    Examples
    --------
    >>> key_name("upper plate-2")
    'upper plate-2'
    """
    if not _KEY.fullmatch(name):
        raise ValueError(f"{name!r} cannot be a name here; write it with letters, digits, '_', '-' and single spaces")
    return name


def folder_name(name: str) -> str:
    """Return a name that a folder can have.

    Raises
    ------
    ValueError
        With what is allowed.

    Examples
    --------
    >>> folder_name("Fig. 9 (model 2)")
    'Fig. 9 (model 2)'
    """
    if not name.strip() or name.strip(".") == "":
        raise ValueError(
            f"{name!r} cannot name the folder of a run; give the scene a 'name' with at least one letter or digit"
        )
    if not name.isprintable() or "/" in name or "\\" in name:
        raise ValueError(
            f"{name!r} cannot name the folder of a run; give the scene a 'name' without '/', '\\' and what does "
            "not print (the folder itself is chosen with -o)"
        )
    length = len(name.encode())
    if length > MOST_BYTES:
        raise ValueError(f"the name has {length} bytes; a folder of a run takes {MOST_BYTES}")
    return name


Key = Annotated[str, AfterValidator(key_name)]
FolderName = Annotated[str, AfterValidator(folder_name)]
