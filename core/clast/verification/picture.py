"""The picture of a family: one panel a sketch, closed forms as lines and computed numbers as dots."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle
from pathlib import Path
from textwrap import fill
from typing import Any

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from clast.verification.sketch import Sketch

STYLE = {
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "legend.fontsize": 7.5,
}
LINE_COLOURS = ("#2166ac", "#7f8792", "#1b7837", "#762a83", "#8c510a", "#01665e")
LINE_STYLES = ("-", "--", "-.", ":")
DOT_COLOURS = ("#b2182b", "#e08214", "#4d4d4d", "#5aae61", "#9970ab", "#35978f")
ACROSS = 3
"""Most panels in a row."""

BELOW = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.22), "borderaxespad": 0.0}
"""Where legends stand: below their panels, so that they hide nothing."""

LONG = 22
"""Characters from which on a label takes a row of its own."""

TALL = 32
"""Characters of a label that go beside an axis."""

SHORT = 100.0
"""Ratio of the ends of a logarithmic axis below which it counts as short."""


def draw(sketches: Sequence[Sketch], file: Path) -> None:
    """Draw the panels and write them as PNG."""
    across = 2 if len(sketches) == 4 else min(ACROSS, len(sketches))
    down = -(-len(sketches) // across)
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(3.7 * across, 3.3 * down), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.subplots(down, across, squeeze=False).ravel()
        for axis, sketch in zip(axes, sketches, strict=False):
            draw_panel(axis, sketch)
        for axis in axes[len(sketches) :]:
            axis.set_visible(False)
        file.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(file, format="png", dpi=110, metadata={"Software": None})


def draw_panel(axis: Any, sketch: Sketch) -> None:
    """Draw one sketch."""
    lines, dots = zip(cycle(LINE_COLOURS), cycle(LINE_STYLES), strict=False), cycle(DOT_COLOURS)
    for line in sketch.lines:
        if line.dots:
            axis.plot(
                line.x, line.y, "o", color=next(dots), markersize=3.4, fillstyle="none", label=line.label, zorder=3
            )
        else:
            colour, style = next(lines)
            axis.plot(line.x, line.y, style, color=colour, linewidth=1.3, label=line.label)
    axis.set_title(sketch.title)
    axis.set_xlabel(sketch.x_label)
    axis.set_ylabel(fill(sketch.y_label, TALL))
    if sketch.logarithmic:
        axis.set_xscale("log")
        axis.set_yscale("log")
        for each in (axis.xaxis, axis.yaxis):
            label_plainly(each)
    if sketch.round:
        axis.set_aspect("equal", adjustable="datalim")
    axis.legend(ncols=1 if max(len(line.label) for line in sketch.lines) > LONG else 2, **BELOW)


def label_plainly(axis: Any) -> None:
    """Label a short logarithmic axis with numbers as 1, 2, 3, 5, a long one with powers of ten alone."""
    low, high = axis.get_view_interval()
    if high < SHORT * low:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 3.0, 5.0)))
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_formatter(NullFormatter())
