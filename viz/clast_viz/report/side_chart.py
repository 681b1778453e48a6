"""Side chart: what bottom and wall around carry in a compression, and the lateral pressure coefficient."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from clast.results.run import Run
from clast_viz.compare import Line
from clast_viz.curves import has_compression
from clast_viz.report.axes import finish, new_axes

LOADED = 0.02
"""Share of the peak stress below which the coefficient, a ratio of small numbers, is not drawn."""
SHOWN = (("stress_Pa", "upper wall", "-"), ("stress_lower_Pa", "lower wall", "--"), ("stress_side_Pa", "side", ":"))


def has_side(run: Run) -> bool:
    """Tell whether a run has a compression with a wall around."""
    return has_compression(run) and "stress_side_Pa" in run.curves


def side(lines: Sequence[Line]) -> Any:
    """Draw the stresses on upper wall, lower wall and side over strain, and the lateral pressure coefficient below."""
    figure, (upper, lower) = new_axes(2)
    for run, _, style in lines:
        curves, colour = run.curves, style["color"]
        strain = 100.0 * curves["strain"]
        for column, _, dashes in SHOWN:
            upper.plot(strain, curves[column] / 1e6, linewidth=1.4, color=colour, linestyle=dashes)
        loaded = curves["stress_Pa"] > LOADED * np.nanmax(curves["stress_Pa"])
        lower.plot(strain, np.where(loaded, curves["lateral_pressure_coefficient"], np.nan), linewidth=1.4, **style)
    for _, name, dashes in SHOWN:
        upper.plot([], [], color="#555555", linestyle=dashes, label=name)
    upper.legend(loc="upper left")
    finish(upper, "", "stress [MPa]")
    finish(lower, "strain [%]", "K")
    figure.align_ylabels()
    return figure
