"""Axes of the charts of a report: all of one size and one look."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast_viz.curves import time_axis

GRID = {"color": "#e4e7eb", "linewidth": 0.7}
HEIGHTS = {1: 3.8, 2: 4.9, 3: 6.0}
"""In inches, by the number of axes below each other."""


def new_axes(rows: int) -> tuple[Any, Any]:
    """Return a figure, and its axes below each other on one x axis."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.2, HEIGHTS[rows]), layout="constrained")
    return figure, figure.subplots(rows, 1, sharex=True, squeeze=False)[:, 0]


def finish(axes: Any, x: str, y: str) -> None:
    """Label axes, start them at zero and draw their grid."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.margins(x=0.0)
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    axes.grid(**GRID)
    axes.set_axisbelow(True)


def on_one_axis(times: Sequence[NDArray[np.float64]]) -> tuple[list[NDArray[np.float64]], str]:
    """Return times in one unit, and the label of their axis."""
    together, label = time_axis(np.concatenate(times))
    return np.split(together, np.cumsum([len(each) for each in times])[:-1]), label
