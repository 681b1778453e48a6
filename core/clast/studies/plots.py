"""Plots of a study: the curves of all points over each other, and measures along every axis."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from clast.config.scene import SceneConfig
from clast.results.whole_file import whole_file
from clast.studies.statistics import statistic, values_of
from clast.studies.table import Row, Table, curves

STYLE = {
    "font.size": 9.0,
    "axes.titlesize": 10.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
}
SHOWN = {
    "peak_stress_Pa": ("peak stress, MPa", 1e-6),
    "strain_at_peak": ("strain at the peak, %", 100.0),
    "slope_5_15_Pa": ("slope from 5 to 15 % strain, MPa", 1e-6),
    "largest_drop": ("largest drop, % of the peak", 100.0),
}
"""Measures that are drawn, with what stands at their axis and its factor."""

WIDTH, HANDLE = 64, 8
"""Characters that a legend below one panel has room for, and those that the line before each label takes."""

MOST = 12
"""Curves of points that a legend can name."""

WIDE = 50.0
"""Ratio of the ends of an axis from which on it is logarithmic."""

LINES = ("#4477aa", "#ee6677", "#228833", "#aa3377", "#ccbb44", "#66ccee")


def draw_curves(table: Table, scene: SceneConfig, path: Path) -> bool:
    """Draw the mean curve of every point, with the scatter of its repeats; False where there are no curves."""
    variants = [variant for variant in table.variants if any(row.curve for row in table.done(variant))]
    if not variants:
        return False
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(5.2 * len(variants), 4.2), layout="constrained")
        FigureCanvasAgg(figure)
        panels = figure.subplots(1, len(variants), sharey=True, squeeze=False)[0]
        for axis, variant in zip(panels, variants, strict=True):
            _draw_variant(axis, list(table.points(variant)), scene)
            axis.set(title=variant, xlabel="strain, %", xlim=(0.0, None))
        panels[0].set(ylabel="stress, MPa", ylim=(0.0, None))
        _draw_legend(figure, panels, table)
        _save(figure, path)
    return True


def _draw_legend(figure: Figure, panels: Sequence[Any], table: Table) -> None:
    """Name every curve once, below all panels, in as many columns as its labels leave room for."""
    named = {label: handle for axis in panels for handle, label in zip(*axis.get_legend_handles_labels(), strict=True)}
    if not named:
        return
    columns = max(1, min(len(named), WIDTH * len(panels) // (max(map(len, named)) + HANDLE)))
    few = all(len(list(table.points(variant))) <= MOST for variant in table.variants)
    title = ", ".join(table.axes) if table.axes and few else None
    figure.legend(named.values(), named.keys(), title=title, loc="outside lower center", ncols=columns)


def _draw_variant(axis: Any, points: Sequence[tuple[int, list[Row]]], scene: SceneConfig) -> None:
    shades = mpl.colormaps["viridis"](np.linspace(0.0, 0.9, max(len(points), 2)))
    for (_, rows), colour in zip(points, shades, strict=False):
        with_curves = [row for row in rows if row.curve is not None]
        if not with_curves:
            continue
        strain, stress, _ = curves(with_curves)
        mean, deviation = stress.mean(axis=0) / 1e6, stress.std(axis=0) / 1e6
        label = ", ".join(setting.label for setting in rows[0].task.settings)
        if len(points) > MOST:
            axis.plot(100.0 * strain, mean, color=colour, linewidth=0.6, alpha=0.5)
            continue
        axis.plot(100.0 * strain, mean, color=colour, linewidth=1.4, label=label)
        axis.fill_between(100.0 * strain, mean - deviation, mean + deviation, color=colour, alpha=0.15, linewidth=0.0)
    if len(points) > MOST:
        _draw_mean(axis, [row for _, rows in points for row in rows])
    for each in scene.reference:
        marker = axis.errorbar(
            100.0 * each.strain,
            each.stress / 1e6,
            xerr=100.0 * each.strain_deviation or None,
            yerr=each.stress_deviation / 1e6 or None,
            fmt="o",
            color="black",
            markersize=4.0,
            linewidth=0.8,
        )
        axis.legend([marker], [each.label], loc="upper left")


def _draw_mean(axis: Any, rows: Sequence[Row]) -> None:
    """Draw the mean of all curves, with the 95 % confidence band of that mean and one deviation."""
    strain, stress, _ = curves(rows)
    stress = stress[np.isfinite(stress).all(axis=1)] / 1e6
    found = [statistic(column.tolist()) for column in stress.T]
    mean, deviation, low, high = (
        np.array([getattr(each, name) for each in found]) for name in ("mean", "deviation", "low", "high")
    )
    axis.plot(100.0 * strain, mean, color="black", linewidth=1.6, label=f"mean of {len(stress)}")
    axis.fill_between(100.0 * strain, low, high, color="black", alpha=0.35, linewidth=0.0, label="its 95 % band")
    for edge in (mean - deviation, mean + deviation):
        axis.plot(100.0 * strain, edge, color="black", linewidth=0.7, linestyle=":")


TICKS = 4
"""Intervals of an axis whose labels a small panel has room for."""


DECADES = 100.0
"""Ratio of the ends of a logarithmic axis below which powers of ten alone are too few labels."""


def few_ticks(panel: Any) -> None:
    """Leave room between the labels below a small panel, which holds what it is to show already."""
    if panel.get_xscale() == "linear":
        panel.locator_params(axis="x", nbins=TICKS)
        return
    low, high = panel.get_xlim()
    panel.xaxis.set_minor_formatter(NullFormatter())
    if high < DECADES * low:
        panel.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        panel.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))


def axis_label(name: str, unit: str) -> str:
    """Return what stands below a plot along an axis; bare numbers are SI."""
    return f"{name}, {unit}" if unit else f"{name} (SI)"


def draw_measures(table: Table, path: Path) -> bool:
    """Draw measures along every axis whose values are numbers; False where there is none."""
    with mpl.rc_context(STYLE):
        figure = measures_figure(table)
        if figure is not None:
            _save(figure, path)
    return figure is not None


def measures_figure(table: Table) -> Figure | None:
    """Return measures along every axis whose values are numbers; None where there is none."""
    axes = [name for name in table.axes if all(isinstance(row.value(name), float) for row in table.rows)]
    shown = [name for name in SHOWN if name in table.measures]
    if not axes or not shown:
        return None
    figure = Figure(figsize=(3.6 * len(shown), 3.2 * len(axes)), layout="constrained")
    FigureCanvasAgg(figure)
    panels = figure.subplots(len(axes), len(shown), squeeze=False)
    for row, name in zip(panels, axes, strict=True):
        for panel, measure in zip(row, shown, strict=True):
            _draw_measure(panel, table, name, measure)
    if any(table.variants):
        figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _draw_measure(panel: Any, table: Table, axis: str, measure: str) -> None:
    label, factor = SHOWN[measure]
    for variant, colour in zip(table.variants, LINES, strict=False):
        found = [
            (rows[0].setting(axis).shown or 0.0, statistic(sample))
            for _, rows in table.points(variant)
            if (sample := values_of(rows, measure))
        ]
        found.sort(key=lambda each: each[0])
        if not found:
            continue
        x = np.array([value for value, _ in found])
        mean, deviation = (np.array([getattr(each, name) for _, each in found]) for name in ("mean", "deviation"))
        panel.errorbar(
            x,
            factor * mean,
            yerr=factor * deviation,
            fmt="o-" if len(table.axes) == 1 else "o",
            color=colour,
            markersize=3.5,
            linewidth=1.0,
            capsize=2.0,
            label=variant or None,
        )
        if x.min() > 0.0 and x.max() / x.min() > WIDE:
            panel.set_xscale("log")
    few_ticks(panel)
    panel.set(xlabel=axis_label(axis, table.rows[0].setting(axis).unit), ylabel=label)


def _save(figure: Figure, path: Path) -> None:
    with whole_file(path) as draft:
        figure.savefig(draft, format="png", dpi=110, metadata={"Software": None})
