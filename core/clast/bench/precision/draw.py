"""The work–precision diagram: error against CPU time, both logarithmic, every line with its name at its end."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from clast.bench.plot import new_figure, save
from clast.bench.precision.claim import gain, known, sentence
from clast.bench.precision.problem import Problem
from clast.bench.precision.sweep import Series, Swept

COLOURS = ("#1f6f8b", "#d1782f", "#6a4c93", "#2e8b57", "#b5325b", "#7a6a2f")
PEER_COLOUR = "#777777"
DASHES = ("-", (0, (4, 1.5)), (0, (1, 1.2)), (0, (5, 1, 1, 1)))
MARKERS = ("o", "s", "^", "D")
LEAST_GAP = 0.052


def draw(problem: Problem, found: Swept, file: Path) -> None:
    """Draw the sweep and write it as PNG."""
    figure, (axis,) = new_figure(1, 7.2, 4.3)
    axis.set_xscale("log")
    axis.set_yscale("log")
    drawn = [series for series in found.series if known(series)]
    colours, dashes = styles(drawn)
    for k, series in enumerate(drawn):
        x, y = [p.cpu_s for p in known(series)], [p.error for p in known(series)]
        style = dashes[k]
        axis.plot(x, y, color=colours[k], linestyle=DASHES[style], marker=MARKERS[style], markersize=4.5, linewidth=1.6)
    what = "CPU seconds" if found.copies == 1 else f"CPU seconds for {found.copies} copies"
    axis.set_xlabel(f"{what}, one thread")
    axis.set_ylabel(f"relative error of the {problem.quantity}", fontsize=9)
    axis.set_title(f"{problem.title}\n{sentence(gain(found))}", fontsize=10, loc="left")
    axis.spines[["top", "right"]].set_visible(False)
    axis.grid(True, which="major", color="#e4e4e4", linewidth=0.7)
    axis.set_axisbelow(True)
    _plain_numbers(axis)
    _name_ends(axis, drawn, colours)
    save(figure, file)


def styles(drawn: list[Series]) -> tuple[list[str], list[int]]:
    """Return a colour for every integrator and a kind of line for every kinematics; the peer is grey."""
    names = list(dict.fromkeys(each.way.get("integrator") for each in drawn if each.way))
    kinds = list(dict.fromkeys(each.way.get("bond_kinematics") for each in drawn if each.way))
    colours = [
        COLOURS[names.index(each.way["integrator"]) % len(COLOURS)] if each.way else PEER_COLOUR for each in drawn
    ]
    dashes = [kinds.index(each.way.get("bond_kinematics")) % len(DASHES) if each.way else 0 for each in drawn]
    return colours, dashes


def _name_ends(axis: Any, drawn: list[Series], colours: list[str]) -> None:
    """Write names in a column beside the ends of the lines, none upon another."""
    low, high = np.log10(axis.get_ylim())
    ends = [float((np.log10(known(each)[-1].error) - low) / (high - low)) for each in drawn]
    costs = [known(each)[-1].cpu_s for each in drawn]
    for k, height in spread_apart(ends, costs).items():
        order = "" if drawn[k].order is None else f"  (order {drawn[k].order:.1f})"
        axis.annotate(
            f"{drawn[k].label}{order}",
            xy=(known(drawn[k])[-1].cpu_s, known(drawn[k])[-1].error),
            xycoords="data",
            xytext=(1.03, height),
            textcoords="axes fraction",
            color=colours[k],
            fontsize=8.5,
            va="center",
            arrowprops={
                "arrowstyle": "-",
                "color": colours[k],
                "linewidth": 0.5,
                "alpha": 0.6,
                "shrinkB": 4,
                "relpos": (0.0, 0.5),
            },
        )


def _plain_numbers(axis: Any) -> None:
    """Write 0.002, 0.005, 0.01 below the axis of time."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.xaxis.set_minor_formatter(NullFormatter())
    axis.tick_params(axis="x", labelsize=8)


def spread_apart(heights: list[float], costs: list[float]) -> dict[int, float]:
    """Return heights in the order of the given ones, at least a line apart; of equal ones the dearer is lower.

    >>> spread_apart([0.5, 0.1, 0.1], [1.0, 1.0, 2.0])
    {2: 0.1, 1: 0.152, 0: 0.5}
    """
    placed: dict[int, float] = {}
    last = -1.0
    for k in sorted(range(len(heights)), key=lambda k: (round(heights[k], 1), -costs[k])):
        last = max(heights[k], round(last + LEAST_GAP, 6))
        placed[k] = last
    return placed
