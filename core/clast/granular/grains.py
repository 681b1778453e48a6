"""Grains: what a bed is made of before anything breaks, and the envelope of each grain."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from clast.errors import RunError
from clast.granular.cut_spheres import sphere_volumes
from clast.granular.envelope import hull_volume
from clast.results.reading import CONFIG_FILE
from clast.results.run import Run

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Grains:
    """The grains of a run as they were packed. ``n`` primaries, ``g`` grains.

    Attributes
    ----------
    of_primary : (n,) int64
        Grain of each primary, from 0; −1 for particles that belong to none.
    primaries : (g,) int64
        How many each grain has.
    primary_volume, primary_mass : (n,) float64
        Of each primary in m³ and kg; overlaps are not subtracted, and mass scaling does not count.
    volume, mass : (g,) float64
        Sums over the primaries of a grain: its solid volume in m³ and its mass in kg.
    envelope : (g,) float64
        Volume of the convex hull of a grain's primaries in m³, its pores included.
    """

    of_primary: Ints
    primaries: Ints
    primary_volume: Floats
    primary_mass: Floats
    volume: Floats
    mass: Floats
    envelope: Floats

    @property
    def count(self) -> int:
        """How many grains there are."""
        return len(self.primaries)

    @cached_property
    def porosity(self) -> Floats:
        """Share of each grain's envelope that its primaries leave free, (g,); at least 0."""
        return np.maximum(1.0 - self.volume / self.envelope, 0.0)


def sums(body: Ints, values: Floats, count: int) -> Floats:
    """Return the sum of values over each of ``count`` bodies, (count,).

    >>> sums(np.array([0, 2, 2]), np.array([1.0, 2.0, 3.0]), 3).tolist()
    [1.0, 0.0, 5.0]
    """
    return np.asarray(np.bincount(body, values, count), float)


def grains_of(run: Run) -> Grains:
    """Return the grains of a run, with the envelopes they have in its first frame.

    Raises
    ------
    RunError
        If the run has no grains, kept no frames, or its config does not tell the densities.
    """
    count = int(run.grain.max(initial=-1)) + 1
    if not count:
        raise RunError(f"{run.folder}: has no grains: none of its particles are bonded or packed together")
    if not run.n_frames:
        raise RunError(f"{run.folder}: keeps no frames (output.frames: 0), so there is nothing to look at")
    inside = run.grain >= 0
    volume = sphere_volumes(run.radius)
    mass = _densities(run)[run.material] * volume

    def of_grains(values: Floats) -> Floats:
        return sums(run.grain[inside], values[inside], count)

    return Grains(
        of_primary=run.grain,
        primaries=np.bincount(run.grain[inside], minlength=count),
        primary_volume=volume,
        primary_mass=mass,
        volume=of_grains(volume),
        mass=of_grains(mass),
        envelope=_envelopes(run, count),
    )


def _densities(run: Run) -> Floats:
    """Return the density of each material in kg/m³."""
    told = run.config.get("materials") or {}
    try:
        return np.array([float(told[name]["density"]) for name in run.materials])
    except (KeyError, TypeError, ValueError) as error:
        where = run.folder / CONFIG_FILE
        raise RunError(f"{where}: does not tell the densities of {', '.join(run.materials)}; it is needed") from error


def _envelopes(run: Run, count: int) -> Floats:
    position = run.frame(0).unwrapped
    order = np.argsort(run.grain, kind="stable")
    bounds = np.searchsorted(run.grain[order], np.arange(count + 1))
    members = [order[first:last] for first, last in pairwise(bounds)]
    return np.array([hull_volume(position[each], run.radius[each]) for each in members])
