"""Kept fills: a finished fill in a file, used again as long as it was asked for with the same keys."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from clast.errors import ConfigError, one_line
from clast.parts.generator import Packing
from clast.results.whole_file import whole_file

ARRAYS = ("position", "radius", "grain")


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
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise ConfigError(f"{path} is no finished fill ({one_line(error)}); remove it, or name another file") from error
    other = ", ".join(different(given, wanted))
    if other:
        raise ConfigError(
            f"{path} keeps a fill made with another {other}; remove it to make the fill anew, or name another file"
        )
    n = len(tables["radius"])
    return Packing(
        **tables,
        material=[material[k] for k in range(n)] if len(material) == n else material * n,
        velocity=np.zeros((n, 3)),
        spin=np.zeros((n, 3)),
        prescribed=np.zeros(n, np.bool_),
        report=report,
    )


def write(path: Path, packing: Packing, keys: dict[str, Any]) -> None:
    """Keep a fill in a file, which appears whole or not at all.

    Raises
    ------
    ConfigError
        If the file cannot be written.
    """
    import h5py

    material = sorted(set(packing.material))
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with whole_file(path) as draft, h5py.File(draft, "w") as file:
            for name in ARRAYS:
                file[name] = getattr(packing, name)
            file.attrs["keys"] = json.dumps(keys)
            file.attrs["report"] = json.dumps(dict(packing.report))
            file.attrs["material"] = json.dumps(material if len(material) == 1 else packing.material)
    except OSError as error:
        raise ConfigError(
            f"{path}: cannot be written ({one_line(error)}); free some space, or name another file"
        ) from error


def different(one: Any, other: Any, at: str = "") -> list[str]:
    """Return the keys, with dots, at which two pieces of plain data differ.

    >>> different({"seed": 1, "a": {"b": 2}}, {"seed": 1, "a": {"b": 3}})
    ['a.b']
    """
    if isinstance(one, dict) and isinstance(other, dict):
        keys = sorted({*one, *other})
        return [place for key in keys for place in different(one.get(key), other.get(key), f"{at}.{key}".strip("."))]
    return [] if one == other else [at]
