"""Figure: stress over strain with the measured crushing point, and the bonds broken below."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from clast.parts.params import Params
from clast.parts.writer import Written
from clast.results.reference import Reference
from clast.results.run import Run
from clast_viz.curves import has_compression, peak

FILE = "stress_strain.png"

STYLE = {
    "font.size": 10.0,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.labelpad": 5.0,
    "xtick.direction": "out",
    "legend.frameon": False,
    "legend.fontsize": 9.0,
    "lines.solid_joinstyle": "round",
}
CURVE_COLOUR = "#b2182b"
BROKEN_COLOUR = "#7f8792"
REFERENCE_COLOUR = "#2166ac"


class FigureParams(Params):
    """What the user can choose about the figure."""

    dpi: Annotated[int, Field(ge=50, le=1200, description="Resolution in dots per inch")] = 200


def write_figure(run: Run, params: FigureParams, path: Path) -> Written:
    """Write ``stress_strain.png``: the curve, its peak, the reference points, the bonds broken."""
    if not has_compression(run):
        return Written(None, "the scene has no compression, or no sample was taken")
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        save(stress_strain_figure(run, run.name, run.reference), path, params.dpi)
    return Written(path)


def stress_strain_figure(run: Run, label: str, references: Sequence[Reference]) -> Any:
    """Return a figure of the curve, its peak, the reference points and the bonds broken; the run must have a curve."""
    figure, upper, lower = new_axes(with_bonds=len(run.bond_ends) > 0)
    percent, stress = 100.0 * run.curves["strain"], run.curves["stress_Pa"] / 1e6
    broken = run.curves["bonds_broken"]
    upper.plot(percent, stress, color=CURVE_COLOUR, linewidth=1.6, label=label, zorder=3)
    _mark_peak(upper, run)
    draw_references(upper, references)
    if lower is not None:
        lower.plot(percent, broken, color=BROKEN_COLOUR, linewidth=1.4)
        lower.fill_between(percent, broken, color=BROKEN_COLOUR, alpha=0.18, linewidth=0)
    finish_axes(upper, lower)
    return figure


def new_axes(*, with_bonds: bool) -> tuple[Any, Any, Any | None]:
    """Return a figure, its stress–strain axes and, below them on the same strain axis, the bonds broken."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.2, 4.9 if with_bonds else 3.8), layout="constrained")
    if not with_bonds:
        return figure, figure.subplots(), None
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[3.2, 1.0])
    return figure, upper, lower


def draw_references(axes: Any, references: Sequence[Reference]) -> None:
    """Draw each measured point with one standard deviation to each side."""
    for reference, marker in zip(references, "oDs^vP" * (1 + len(references) // 6), strict=False):
        axes.errorbar(
            100.0 * reference.strain,
            reference.stress / 1e6,
            xerr=100.0 * reference.strain_deviation or None,
            yerr=reference.stress_deviation / 1e6 or None,
            fmt=marker,
            color=REFERENCE_COLOUR,
            markersize=6.0,
            elinewidth=1.1,
            capsize=3.0,
            label=reference.label,
            zorder=4,
        )


def finish_axes(upper: Any, lower: Any | None) -> None:
    """Label the axes, start them at zero and set the legend."""
    upper.set_ylabel("stress [MPa]")
    upper.set_ylim(bottom=0.0)
    upper.margins(x=0.015)  # room for the caps of error bars at the right
    upper.set_xlim(left=0.0)
    upper.grid(color="#e4e7eb", linewidth=0.7)
    upper.set_axisbelow(True)
    # above the axes: inside, long labels and the scatter of the reference would hide the curve
    entries = len(upper.get_legend_handles_labels()[1])
    if entries:
        upper.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2, ncols=2 if entries > 3 else 1)
    bottom = upper
    if lower is not None:
        lower.set_ylabel("bonds broken")
        lower.set_ylim(bottom=0.0)
        lower.grid(color="#e4e7eb", linewidth=0.7)
        lower.set_axisbelow(True)
        upper.get_figure().align_ylabels()
        bottom = lower
    bottom.set_xlabel("strain [%]")


def save(figure: Any, path: Path, dpi: int) -> None:
    """Write a PNG that is the same for the same data: no date, no version inside."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    FigureCanvasAgg(figure)
    figure.savefig(path, format="png", dpi=dpi, metadata={"Software": None})


def _mark_peak(axes: Any, run: Run) -> None:
    top = peak(run)
    if top.stress <= 0.0:
        return  # nothing pressed on the upper wall
    percent, stress = 100.0 * top.strain, top.stress / 1e6
    name = "highest so far" if run.summary.get("peak_inside_run") is False else "peak"
    # the value stands in the legend, where no curve or error bar can cover it
    axes.plot(
        percent,
        stress,
        linestyle="none",
        marker="o",
        markersize=6.5,
        markerfacecolor="white",
        markeredgecolor=CURVE_COLOUR,
        markeredgewidth=1.5,
        label=f"{name}: {stress:.2f} MPa at {percent:.1f} % strain",
        zorder=5,
    )
