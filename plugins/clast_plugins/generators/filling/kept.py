"""Kept fills: a finished fill in a file, used again as long as it was asked for with the same keys."""

from __future__ import annotations

import errno
import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryFile
from typing import Any

import numpy as np

from clast.errors import ConfigError, one_line
from clast.parts.generator import Packing
from clast.results.room import in_memory
from clast.results.whole_file import whole_file

ARRAYS = ("position", "radius", "grain")
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
FORMAT = 1
"""Number of the way in which fills are made: another one makes another fill of the same keys."""


def read(path: Path, wanted: dict[str, Any]) -> Packing | None:
    """Return the fill that a file keeps; None where there is no file.

    Parameters
    ----------
    path : Path
    wanted : dict
        The keys of the fill that is asked for, as plain data.

    Raises
    ------
    ConfigError
        If the file is none of a fill, or that of another.
    """
    if not path.exists():
        return None
    import h5py

    try:
        with h5py.File(path, "r") as file:
            given = json.loads(file.attrs["keys"])
            tables = {name: file[name][:] for name in ARRAYS}
            material, report = json.loads(file.attrs["material"]), json.loads(file.attrs["report"])
            relieved, form = bool(file.attrs["relieved"]), int(file.attrs["format"])
        n = {len(table) for table in tables.values()}
        if len(n) != 1 or len(material) not in (1, *n):
            raise ValueError("its tables differ in length")
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise ConfigError(f"{path} is no finished fill ({one_line(error)}); remove it, or name another file") from error
    if form != FORMAT:
        raise ConfigError(f"{path} was made by another version of Clast; remove it, or name another file")
    used = {name: wanted["density"].get(name) for name in given["density"]}
    other = ", ".join(different(given, wanted | {"density": used}))
    if other:
        raise ConfigError(
            f"{path} keeps a fill made with another {other}; remove it to make the fill anew, or name another file"
        )
    count = len(tables["radius"])
    return Packing(
        **tables,
        material=material if len(material) == count else material * count,
        velocity=np.zeros((count, 3)),
        spin=np.zeros((count, 3)),
        prescribed=np.zeros(count, np.bool_),
        relieved=relieved,
        report=report,
    )


def make_room(path: Path) -> None:
    """Make sure that a fill can be kept in a file, before it is made.

    Raises
    ------
    ConfigError
        If nothing can be written there.
    """
    with _telling(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=path.parent):
            pass


def write(path: Path, packing: Packing, keys: dict[str, Any]) -> None:
    """Keep a fill in a file, which appears whole or not at all.

    Raises
    ------
    ConfigError
        If the file cannot be written.
    """
    material = sorted(set(packing.material))
    keys = keys | {"density": {name: keys["density"].get(name) for name in material}}

    def fill(file: Any) -> None:
        for name in ARRAYS:
            file[name] = getattr(packing, name)
        file.attrs["keys"], file.attrs["report"] = json.dumps(keys), json.dumps(dict(packing.report))
        file.attrs["material"] = json.dumps(material if len(material) == 1 else packing.material)
        file.attrs["relieved"], file.attrs["format"] = packing.relieved, FORMAT

    with _telling(path), whole_file(path) as draft:
        draft.write_bytes(in_memory(fill))


@contextmanager
def _telling(path: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        advice = "free some space, or name" if error.errno in FULL else "name"
        raise ConfigError(f"{path}: cannot be written ({error.strerror}); {advice} another file") from error


def different(one: Any, other: Any, at: str = "") -> list[str]:
    """Return the keys, with dots, at which two pieces of plain data differ.

    >>> different({"seed": 1, "a": {"b": 2}}, {"seed": 1, "a": {"b": 3}})
    ['a.b']
    """
    if isinstance(one, dict) and isinstance(other, dict):
        keys = sorted({*one, *other})
        return [place for key in keys for place in different(one.get(key), other.get(key), f"{at}.{key}".strip("."))]
    return [] if one == other else [at]
