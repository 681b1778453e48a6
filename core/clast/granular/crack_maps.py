"""Crack maps: when and where bonds broke."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clast.granular.bed import Bed
from clast.results.run import Run

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class CrackMaps:
    """Numbers of cracks in ``s`` steps of strain (of time without a compression) and ``b`` places.

    Attributes
    ----------
    over : str
        ``"strain"`` or ``"time_s"``.
    edges : (s + 1,) float64
        Bounds of the steps.
    height_edges, radius_edges : (b + 1,) float64
        Bounds of slabs, over the lower plate as it was then, and of rings about the axis, in m. All rings have the same
        area, so equal cracking shows as equal numbers.
    by_height, by_radius : (b, s) int64
        Cracks in each; every crack is in one of them.
    by_mode : (k, s) int64
        By the modes in ``Run.crack_modes``.
    """

    over: str
    edges: Floats
    height_edges: Floats
    radius_edges: Floats
    by_height: Ints
    by_radius: Ints
    by_mode: Ints

    @property
    def total(self) -> Ints:
        """Cracks in each step, (s,)."""
        return np.asarray(self.by_height.sum(axis=0))

    @property
    def rate(self) -> Floats:
        """Cracks in each step by its width, (s,): per unit strain, or per s."""
        return np.asarray(self.total / np.diff(self.edges))


def crack_maps(run: Run, bed: Bed, floor: tuple[Floats, Floats], height: float, bins: int) -> CrackMaps:
    """Return the maps of the cracks of a run that has frames.

    Parameters
    ----------
    run : Run
    bed : Bed
    floor : (times, heights) of (F,) float64
        Height of the bed's lower end over time, in s and m.
    height : float
        Of the bed at the start, in m.
    bins : int
        Steps of strain, and places.
    """
    over, when, end = _progress(run)
    position, mode = run.cracks["position"], run.cracks["mode"].astype(np.int64)
    above = bed.heights(position) - np.interp(run.cracks["time"], *floor)
    distance = bed.distances(position)
    rim = bed.tube if bed.tube is not None else float(distance.max(initial=0.0))
    edges, height_edges, radius_edges = _edges(end, bins), _edges(height, bins), np.sqrt(_edges(rim**2, bins))
    step = _place(when, edges)
    return CrackMaps(
        over=over,
        edges=edges,
        height_edges=height_edges,
        radius_edges=radius_edges,
        by_height=_counts(_place(above, height_edges), step, (bins, bins)),
        by_radius=_counts(_place(distance, radius_edges), step, (bins, bins)),
        by_mode=_counts(mode, step, (len(run.crack_modes), bins)),
    )


def _progress(run: Run) -> tuple[str, Floats, float]:
    """Return what goes on, where it was at each crack, and how far it came."""
    time = run.cracks["time"]
    if "strain" in run.curves and len(run.curves["strain"]):
        strain = run.curves["strain"]
        return "strain", np.interp(time, run.curves["time_s"], strain), float(strain.max())
    return "time_s", time, float(max(time.max(initial=0.0), run.frame_values("time").max()))


def _edges(end: float, bins: int) -> Floats:
    return np.linspace(0.0, end if end > 0.0 else 1.0, bins + 1)


def _place(values: Floats, edges: Floats) -> Ints:
    """Return the bin of each value; what lies beyond the ends counts in the bins there."""
    return np.clip(np.searchsorted(edges, values, "right") - 1, 0, len(edges) - 2)


def _counts(row: Ints, column: Ints, shape: tuple[int, int]) -> Ints:
    return np.bincount(row * shape[1] + column, minlength=shape[0] * shape[1]).reshape(shape)
