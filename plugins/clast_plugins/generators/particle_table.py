"""Particles and bonds as files hold them, whatever their format."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.errors import ConfigError
from clast.parts.generator import BondList


class ParticleTable(NamedTuple):
    """Particles as read.

    Attributes
    ----------
    ids : list of n int
    position : (n, 3) float64
        Centres in m.
    radius : (n,) float64
        In m.
    material : list of n str
    origin : (k) -> str
        Where particle k is written, for messages.
    grain : (n,) int64 or None
        None where the file tells none.
    """

    ids: list[int]
    position: NDArray[np.float64]
    radius: NDArray[np.float64]
    material: list[str]
    origin: Callable[[int], str]
    grain: NDArray[np.int64] | None = None


def bonds_between(particles: ParticleTable, ends: NDArray[np.int64], origin: Callable[[int], str]) -> BondList:
    """Return bonds of which a file tells the ends alone: as thick as the smaller particle, and undeformed."""
    diameter = 2.0 * particles.radius[ends].min(axis=1) if len(ends) else np.zeros(0)
    return BondList(ends, diameter, np.full(len(ends), np.nan), origin)


def named_materials(
    path: Path, kinds: list[int], first: int, material: str | None, names: list[str] | None
) -> list[str]:
    """Return the material of each particle from its number in a file, the first of which is ``first``.

    Raises
    ------
    ConfigError
        A number has no name.
    """
    if names is None:
        if material is None:
            raise ConfigError(
                f"{path} tells materials by numbers; give 'material' for all, or 'materials', a list of their names",
            )
        return [material] * len(kinds)
    unnamed = sorted({kind for kind in kinds if not first <= kind < first + len(names)})
    if unnamed:
        raise ConfigError(
            f"{path} holds the material {unnamed[0]}, and {len(names)} names are given, for {first} to "
            f"{first + len(names) - 1}; name every one in the order of its number",
        )
    return [names[kind - first] for kind in kinds]


def numbered_from_zero(grain: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return grains (n,) numbered without gaps; what belongs to none stays below 0.

    >>> numbered_from_zero(np.array([7, -1, 3, 7])).tolist()
    [1, -1, 0, 1]
    """
    return np.where(grain >= 0, np.searchsorted(np.unique(grain[grain >= 0]), grain), -1)
