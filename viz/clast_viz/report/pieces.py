"""Pieces: how many fragments there are, and how large, while a run goes on and at its end."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clast.results.fragments import fragments
from clast.results.frame import Frame
from clast.results.run import Run

MOST_FRAMES = 60
"""That are looked at; each is read whole."""


@dataclass(frozen=True)
class Pieces:
    """Fragments of a run over its frames.

    Attributes
    ----------
    time, strain : (f,) float64
        Of the frames looked at; time in s.
    count : (f,) int64
        Fragments, single particles included.
    largest : (f,) float64
        Share of the volume of all particles still there that the largest one holds.
    diameters : (p,) float64
        Of the fragments in the last frame, smallest first: of the sphere with the volume of its particles, in m.
    """

    time: NDArray[np.float64]
    strain: NDArray[np.float64]
    count: NDArray[np.int64]
    largest: NDArray[np.float64]
    diameters: NDArray[np.float64]


def pieces(run: Run) -> Pieces | None:
    """Return the fragments of a run; None where it has no bonds or kept no frames.

    Raises
    ------
    RunError
        If a frame cannot be read.
    """
    if not len(run.bond_ends) or not run.n_frames:
        return None
    chosen = np.unique(np.linspace(0, run.n_frames - 1, min(MOST_FRAMES, run.n_frames)).round().astype(int))
    frames = [run.frame(int(k)) for k in chosen]
    sizes = [volumes(run, frame) for frame in frames]
    return Pieces(
        time=np.array([frame.time for frame in frames]),
        strain=np.array([frame.strain for frame in frames]),
        count=np.array([len(each) for each in sizes]),
        largest=np.array([each[-1] / each.sum() if len(each) else 0.0 for each in sizes]),
        diameters=np.cbrt(6.0 / np.pi * sizes[-1]),
    )


def volumes(run: Run, frame: Frame) -> NDArray[np.float64]:
    """Return the volume of the particles of each fragment in a frame, smallest first, in m³."""
    present = np.isfinite(frame.position[:, 0])
    label = fragments(len(run.radius), run.bond_ends.astype(np.int64), frame.bond_intact)
    volume = np.bincount(label[present], weights=4.0 / 3.0 * np.pi * run.radius[present] ** 3)
    return np.sort(volume[volume > 0.0])
