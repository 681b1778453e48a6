"""Charts of a bed of grains: curves of one run by strain, or of several runs over each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.granular.analysis import Granular, Moment
from clast.granular.breakage import ultimate_finer
from clast.granular.damage import CRUSHED, DAMAGED, INTACT
from clast.results.run import Run
from clast_viz.curves import has_compression, time_axis
from clast_viz.report.axes import finish, new_axes, on_one_axis

Floats = NDArray[np.float64]
STATE_COLOURS = {INTACT: "#b9c3ce", DAMAGED: "#f0a04b", CRUSHED: "#b2182b"}
STATE_NAMES = {INTACT: "intact", DAMAGED: "damaged", CRUSHED: "crushed"}
COURSE = ("#4a86c5", "#b65a9c", "#e8862e")
"""Colours of the moments of one run from the first to the last; can be read on a dark page too."""


class Shown(NamedTuple):
    """A run in the section: what was found, the run, its label, and how its lines are drawn."""

    found: Granular
    run: Run
    label: str
    style: dict[str, str]


class Curve(NamedTuple):
    """A moment of a run, its label in the chart, none where the page has it, and how it is drawn."""

    found: Granular
    moment: Moment
    label: str
    style: dict[str, Any]


def curves(shown: Sequence[Shown], *, ends_only: bool) -> Iterator[Curve]:
    """Yield what is drawn: of one run its moments, coloured by strain; of several, of each the first and the last."""
    for each in shown:
        moments = each.found.moments
        chosen = [moments[0], moments[-1]] if (ends_only or len(shown) > 1) and len(moments) > 1 else moments
        for k, moment in enumerate(chosen):
            if len(shown) == 1:
                style = {"color": _mixed(k / max(len(chosen) - 1, 1))}
                yield Curve(each.found, moment, moment_name(each.run, moment), style)
            else:
                faint = {"alpha": 0.45, "linewidth": 1.0} if moment is moments[0] else {}
                yield Curve(each.found, moment, "", each.style | faint)


def moment_name(run: Run, moment: Moment) -> str:
    """Return when a moment was, as a legend says it."""
    if has_compression(run):
        return f"{100.0 * moment.strain:.1f} % strain"
    (time, _), label = time_axis(np.array([moment.time, run.frame_values("time")[-1]]))
    return f"{time:.3g} {label.removeprefix('time [').removesuffix(']')}"


def bulk(shown: Sequence[Shown]) -> Any:
    """Draw the stress, or bonds broken where there is none, and which share of the grains is in which state."""
    figure, axes = new_axes(2 if len(shown) == 1 else 3)
    pressed = all(has_compression(each.run) for each in shown)
    label, over = _over(shown, pressed)
    for each, (sampled, seen) in zip(shown, over, strict=True):
        values = each.run.curves["stress_Pa"] / 1e6 if pressed else each.run.curves["bonds_broken"]
        axes[0].plot(sampled, values, linewidth=1.5, **each.style)
        if len(shown) == 1:
            _stack_states(axes[1], seen, each.found)
        else:
            crushed = each.found.history["grains_crushed"] / each.found.grains.count
            axes[1].plot(seen, 100.0 * crushed, linewidth=1.5, **each.style)
            axes[2].plot(seen, 100.0 * each.found.history["damage"], linewidth=1.5, **each.style)
    finish(axes[0], "", "stress [MPa]" if pressed else "bonds broken")
    names = ["grains [%]"] if len(shown) == 1 else ["grains crushed [%]", "bonds broken [%]"]
    for k, name in enumerate(names, start=1):
        finish(axes[k], label if k == len(names) else "", name)
        axes[k].set_ylim(0.0, 100.0 if len(shown) == 1 else None)
    figure.align_ylabels()
    return figure


def _over(shown: Sequence[Shown], pressed: bool) -> tuple[str, list[tuple[Floats, Floats]]]:
    """Return the label of the x axis and, for each run, the places of its samples and of its frames on it."""
    if pressed:
        places = [(100.0 * each.run.curves["strain"], 100.0 * each.found.history["strain"]) for each in shown]
        return "strain [%]", places
    times = [times for each in shown for times in (each.run.curves["time_s"], each.found.history["time_s"])]
    times, label = on_one_axis(times)
    return label, list(zip(times[::2], times[1::2], strict=True))


def _stack_states(axes: Any, x: Floats, found: Granular) -> None:
    shares = [100.0 * found.history[f"grains_{name}"] / found.grains.count for name in STATE_NAMES.values()]
    areas = axes.stackplot(x, *shares, colors=list(STATE_COLOURS.values()), alpha=0.85, linewidth=0.0)
    (line,) = axes.plot(x, 100.0 * found.history["damage"], color="#000000", linewidth=1.4)
    labels = [*STATE_NAMES.values(), "bonds broken, mean"]
    axes.legend([*areas, line], labels, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2, ncols=4)


def gradings(shown: Sequence[Shown]) -> Any:
    """Draw which share of the mass is in finer fragments, and the ultimate grading after Einav."""
    figure, (axes,) = new_axes(1)
    sizes = np.concatenate([moment.grading.size for each in shown for moment in each.found.moments])
    least = min(sizes.min(), *(each.found.smallest for each in shown))
    ends = 1e3 * np.array([0.92 * least, 1.08 * sizes.max()])
    for curve in curves(shown, ends_only=False):
        size, finer = 1e3 * curve.moment.grading.size, 100.0 * curve.moment.grading.finer
        x, y = np.concatenate([ends[:1], size, ends[1:]]), np.concatenate([[0.0], finer, [100.0]])
        axes.step(x, y, where="post", label=curve.label, **({"linewidth": 1.6} | curve.style))
    found = shown[0].found
    largest = float(found.moments[0].grading.size[-1])
    if found.smallest < largest:
        x = np.geomspace(found.smallest, largest, 100)
        finer = 100.0 * ultimate_finer(x, largest, found.smallest)
        axes.plot(1e3 * x, finer, color="#7f8792", linewidth=1.1, linestyle=":", label="ultimate, fractal")
    finish(axes, "size of fragments [mm]", "mass in finer ones [%]")
    axes.set_xscale("log")
    axes.set_xlim(*ends)
    axes.set_ylim(0.0, 103.0)
    _plain_ticks(axes, *ends)
    _legend_above(axes, 3)
    return figure


def damages(shown: Sequence[Shown]) -> Any:
    """Draw how many grains have lost which share of their bonds at the end."""
    figure, (axes,) = new_axes(1)
    edges = np.linspace(0.0, 100.0, 21)
    if len(shown) == 1:
        hurt = shown[0].found.moments[-1].damage
        parts = [100.0 * hurt.damage[hurt.state == state] for state in STATE_COLOURS]
        colours, names = list(STATE_COLOURS.values()), list(STATE_NAMES.values())
        axes.hist(parts, edges, stacked=True, color=colours, label=names, alpha=0.85, rwidth=0.9)
        _legend_above(axes, 3)
        finish(axes, "bonds broken of a grain [%]", "grains")
        axes.yaxis.get_major_locator().set_params(integer=True)
    else:
        for each in shown:
            broken = 100.0 * each.found.moments[-1].damage.damage
            share = 100.0 * np.histogram(broken, edges)[0] / len(broken)
            axes.stairs(share, edges, linewidth=1.5, **each.style)
        finish(axes, "bonds broken of a grain [%]", "grains [%]")
    axes.set_xlim(0.0, 100.0)
    return figure


def over_height(shown: Sequence[Shown]) -> Any:
    """Draw the share of the room that is filled, over the height of the bed, lying as the bed stands."""
    figure, (axes,) = new_axes(1)
    for curve in curves(shown, ends_only=True):
        profile = curve.moment.height
        style = {"linewidth": 1.6, "orientation": "horizontal", "baseline": None} | curve.style
        axes.stairs(profile.solid, 1e3 * profile.edges, label=curve.label, **style)
        axes.stairs(profile.envelope, 1e3 * profile.edges, **(style | {"linestyle": "--", "linewidth": 1.0}))
    finish(axes, "solid fraction", "height [mm]")
    axes.set_xlim(0.0, 1.05 * axes.dataLim.x1)
    axes.autoscale(axis="y")
    axes.set_ylim(bottom=0.0)
    _legend_above(axes, 3)
    return figure


def near_wall(shown: Sequence[Shown]) -> Any:
    """Draw the share of the room that is filled over the distance from the wall of the tube."""
    figure, (axes,) = new_axes(1)
    for curve in curves(shown, ends_only=True):
        profile = curve.moment.radius
        assert profile is not None
        away = 1e3 * (profile.edges[-1] - profile.edges)[::-1]
        style = {"linewidth": 1.6} | curve.style
        axes.stairs(profile.solid[::-1], away, baseline=None, label=curve.label, **style)
        axes.stairs(profile.envelope[::-1], away, baseline=None, **(style | {"linestyle": "--", "linewidth": 1.0}))
    finish(axes, "distance from the wall [mm]", "solid fraction")
    _legend_above(axes, 3)
    return figure


def coordination(shown: Sequence[Shown]) -> Any:
    """Draw which share of the grains touches how many others."""
    figure, (axes,) = new_axes(1)
    numbers = [int(moment.coordination.max()) for each in shown for moment in each.found.moments]
    most = max(1, *numbers)
    edges = np.arange(most + 2) - 0.5
    for curve in curves(shown, ends_only=True):
        number = curve.moment.coordination
        share = 100.0 * np.bincount(number, minlength=most + 1) / len(number)
        label = f"{curve.label}: {number.mean():.2f} on average" if curve.label else ""
        axes.stairs(share, edges, label=label, **({"linewidth": 1.6} | curve.style))
    finish(axes, "grains that touch a grain", "grains [%]")
    axes.set_xlim(edges[0], edges[-1])
    axes.xaxis.get_major_locator().set_params(integer=True)
    _legend_above(axes, 2)
    return figure


def coordination_over_height(shown: Sequence[Shown]) -> Any:
    """Draw the mean coordination number of the grains whose centres lie in a slab, over the height of the bed."""
    figure, (axes,) = new_axes(1)
    for curve in curves(shown, ends_only=True):
        profile = curve.moment.height
        there = np.isfinite(profile.coordination)
        style = {"linewidth": 1.3, "marker": "o", "markersize": 4.0} | curve.style
        axes.plot(profile.coordination[there], 1e3 * profile.middles[there], label=curve.label, **style)
    finish(axes, "coordination number", "height [mm]")
    axes.set_xlim(0.0, 1.05 * max(axes.dataLim.x1, 1.0))
    _legend_above(axes, 3)
    return figure


def _mixed(share: float) -> Any:
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("course", COURSE)(share)


def _plain_ticks(axes: Any, low: float, high: float) -> None:
    """Label a logarithmic axis with plain numbers; matplotlib would write powers as formulas."""
    decades = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    steps = (1.0, 2.0, 5.0) if high > 10.0 * low else range(1, 10)
    wanted = [step * 10.0**decade for decade in decades for step in steps]
    ticks = [tick for tick in wanted if low <= tick <= high]
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)


def _legend_above(axes: Any, columns: int) -> None:
    if axes.get_legend_handles_labels()[1]:
        axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2, ncols=columns)
