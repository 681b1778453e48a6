"""Charts of a report: each a function from runs to a figure, drawn in the style of the figures of a run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from clast.results.curves import energies
from clast.results.reference import Reference
from clast.results.run import Run
from clast_viz.compare import COLOURS, Line, comparison_figure
from clast_viz.curves import has_compression, time_axis
from clast_viz.energy import energy_axis, energy_figure
from clast_viz.figure import CURVE_COLOUR, stress_strain_figure
from clast_viz.report.axes import finish, new_axes, on_one_axis
from clast_viz.report.pieces import Pieces
from clast_viz.report.printable import printable

MOST_ROWS = 500
"""Of a filled area; a line is simplified as it is drawn."""
SINGLE = {"color": CURVE_COLOUR}
"""How the one run of a report is drawn."""
Pairs = Sequence[tuple[Pieces, dict[str, str]]]


def references(runs: Sequence[Run]) -> list[Reference]:
    """Return the measured points that runs name, each once."""
    known = dict.fromkeys(reference for run in runs for reference in run.reference)
    return [replace(reference, label=printable(reference.label)) for reference in known]


def stress_strain(lines: Sequence[Line]) -> Any:
    """Draw the curve of one run as its own figure shows it, or those of several over each other."""
    runs = [line.run for line in lines]
    if len(runs) == 1:
        return stress_strain_figure(runs[0], "", references(runs))
    return comparison_figure(lines, references(runs))


def bonds_over_time(lines: Sequence[Line]) -> Any:
    """Draw the bonds broken over time, of runs without a compression."""
    figure, (axes,) = new_axes(1)
    times, label = on_one_axis([line.run.curves["time_s"] for line in lines])
    for line, time in zip(lines, times, strict=True):
        axes.plot(time, line.run.curves["bonds_broken"], linewidth=1.4, **line.style)
    finish(axes, label, "bonds broken")
    return figure


def energy(run: Run) -> Any:
    """Draw the ledger of a run, stacked; the run must have one."""
    x, label = energy_axis(run)
    rows = np.unique(np.linspace(0, len(x) - 1, min(MOST_ROWS, len(x))).round().astype(int))
    return energy_figure(x[rows], label, {name: values[rows] for name, values in energies(run.curves).items()})


def fragments(pairs: Pairs, over_strain: bool) -> Any:
    """Draw how many fragments there are and what share the largest holds, over strain or time."""
    figure, (upper, lower) = new_axes(2)
    times, label = on_one_axis([found.time for found, _ in pairs])
    for (found, style), time in zip(pairs, times, strict=True):
        x = 100.0 * found.strain if over_strain else time
        upper.plot(x, found.count, linewidth=1.5, **style)
        lower.plot(x, 100.0 * found.largest, linewidth=1.5, **style)
    finish(upper, "", "fragments")
    finish(lower, "strain [%]" if over_strain else label, "largest [% vol]")
    lower.set_ylim(0.0, 105.0)
    figure.align_ylabels()
    return figure


def sizes(pairs: Pairs) -> Any:
    """Draw the share of the volume in fragments up to a size, at the end: the curve that sieves would give."""
    figure, (axes,) = new_axes(1)
    end = 1.03e3 * max(found.diameters.max(initial=0.0) for found, _ in pairs)
    for found, style in pairs:
        diameter = 1e3 * found.diameters
        share = 100.0 * np.cumsum(diameter**3) / max(float((diameter**3).sum()), 1e-300)
        edge = np.concatenate([[0.0], diameter, [end]])
        axes.step(edge, np.concatenate([[0.0], share, share[-1:]]), where="post", linewidth=1.5, **style)
    finish(axes, "diameter of fragments [mm]", "volume in smaller ones [%]")
    axes.set_ylim(0.0, 105.0)
    return figure


def cracks(run: Run) -> Any:
    """Draw the bonds broken by each mode, stacked over strain or time."""
    over_strain = has_compression(run)
    figure, (axes,) = new_axes(1)
    time = np.linspace(0.0, float(np.max(run.curves["time_s"], initial=run.cracks["time"].max())), MOST_ROWS)
    shown = np.unique(run.cracks["mode"])
    counts = [np.searchsorted(np.sort(run.cracks["time"][run.cracks["mode"] == k]), time, "right") for k in shown]
    x, label = time_axis(time)
    if over_strain:
        x, label = 100.0 * np.interp(time, run.curves["time_s"], run.curves["strain"]), "strain [%]"
    colours = [COLOURS[k % len(COLOURS)] for k in shown]
    areas = axes.stackplot(x, *counts, colors=colours, alpha=0.85, linewidth=0.0)
    axes.legend(areas[::-1], [printable(run.crack_modes[k]) for k in shown][::-1], loc="upper left")
    finish(axes, label, "bonds broken")
    return figure
