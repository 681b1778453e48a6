"""Curves as CSV: one row per sample."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.results.whole_file import whole_file

FILE = "curves.csv"
ENERGY = "energy_{}_J"
"""Name of the column of a term of the energy ledger."""

COUNTS = ("bonds_intact", "bonds_broken", "particles_removed")


def write(path: Path, curves: dict[str, NDArray[np.float64]]) -> Path:
    """Write columns of equal length; floats so that reading gives the same bits again."""
    columns = [[_text(name, value) for value in values.tolist()] for name, values in curves.items()]
    with whole_file(path) as draft, draft.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(curves)
        writer.writerows(zip(*columns, strict=True))
    return path


def energies(curves: dict[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    """Return the terms of the energy ledger among the columns, by name, in J; none where it was off.

    >>> energies({"time_s": np.zeros(1), "energy_kinetic_J": np.ones(1)})
    {'kinetic': array([1.])}
    """
    before, after = ENERGY.split("{}")
    return {
        name.removeprefix(before).removesuffix(after): values
        for name, values in curves.items()
        if name.startswith(before)
    }


def _text(name: str, value: Any) -> str:
    return str(int(value)) if name in COUNTS else repr(float(value))


def flattened(tracks: dict[str, NDArray[np.float64]], numbers: list[int], what: str) -> dict[str, NDArray[np.float64]]:
    """Return the tracks of some particles or bonds as named columns.

    >>> flattened({"intact": np.array([[1.0, 0.0]])}, [3, 5], "bond").keys()
    dict_keys(['bond_3_intact', 'bond_5_intact'])
    """
    columns = {}
    for k, number in enumerate(numbers):
        for name, values in tracks.items():
            one = values[:, k]
            if one.ndim == 1:
                columns[f"{what}_{number}_{name}"] = one
            else:
                columns |= {f"{what}_{number}_{name}_{c}": one[:, a] for a, c in enumerate("xyz")}
    return columns
