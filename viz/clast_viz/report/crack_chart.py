"""Cracks in space and time: a map over height and strain, and one over radius and strain, their rate above."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast_viz.curves import time_axis
from clast_viz.report.axes import finish
from clast_viz.report.grain_charts import Shown

COLOUR = "#b2182b"
CAPTION = (
    "Heights are over the lower plate at that moment. All rings about the axis have the same area, so that even "
    "cracking shows as an even colour."
)
RADII = 5


def most_in_one_place(shown: Sequence[Shown]) -> int:
    """Return the largest number in any map of some runs: the end of a scale that suits all of them."""
    return max(int(max(each.found.cracks.by_height.max(), each.found.cracks.by_radius.max())) for each in shown)


def crack_chart(shown: Shown, most: int) -> Any:
    """Draw the rate of cracks, and where they were, on a scale up to ``most``; the run must have some."""
    from matplotlib.figure import Figure

    cracks = shown.found.cracks
    x, label = (100.0 * cracks.edges, "strain [%]") if cracks.over == "strain" else time_axis(cracks.edges)
    figure: Any = Figure(figsize=(6.2, 5.6), layout="constrained")
    rate, high, far = figure.subplots(3, 1, sharex=True, height_ratios=[1.0, 1.7, 1.7])
    rate.stairs(cracks.total / np.diff(x), x, color=COLOUR, fill=True, alpha=0.75)
    finish(rate, "", f"bonds per {label.split()[1].strip('[]')}")
    _draw_map(high, cracks.by_height, (x[0], x[-1], 0.0, 1e3 * cracks.height_edges[-1]), most)
    high.set_ylabel("height [mm]")
    image = _draw_map(far, cracks.by_radius, (x[0], x[-1], 0.0, 1.0), most)
    _mark_radii(far, 1e3 * float(cracks.radius_edges[-1]))
    far.set_xlabel(label)
    bar = figure.colorbar(image, ax=[high, far], fraction=0.035, pad=0.015, label="bonds broken")
    bar.solids.set_rasterized(True)
    bar.locator.set_params(integer=True)
    bar.update_ticks()
    figure.align_ylabels()
    return figure


def _draw_map(axes: Any, counts: NDArray[np.int64], extent: tuple[float, float, float, float], most: int) -> Any:
    """Draw numbers as shades, 0 as nothing, so that they can be read on a dark page too."""
    from matplotlib.colors import LinearSegmentedColormap, to_rgb

    shades = LinearSegmentedColormap.from_list("cracks", [(*to_rgb(COLOUR), share) for share in (0.0, 0.55, 1.0)])
    return axes.imshow(
        counts,
        cmap=shades,
        origin="lower",
        extent=extent,
        aspect="auto",
        interpolation="none",
        vmin=0.0,
        vmax=most,
    )


def _mark_radii(axes: Any, rim: float) -> None:
    """Label rings of equal area with their radii."""
    step = rim / RADII
    decade = 10.0 ** np.floor(np.log10(step))
    step = decade * next(each for each in (1.0, 2.0, 2.5, 5.0, 10.0) if each * decade >= step)
    radii = np.arange(0.0, rim * (1.0 + 1e-9), step)
    radii = radii[(radii == 0.0) | (radii > 0.3 * rim)]  # the first ones lie too close to 0
    axes.set_yticks((radii / rim) ** 2, [f"{radius:g}" for radius in radii])
    axes.set_ylabel("radius [mm]")
