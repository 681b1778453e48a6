"""Pictures of the benchmark: bars of steps per CPU second, and the speed through a crushing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from clast.bench.measure import number, spread
from clast.bench.startup import FirstRun
from clast.bench.throughput import MODELS, PEER, Comparison

CLAST_COLOUR, PEER_COLOUR = "#1f6f8b", "#b8b8b8"
TITLES = {"grain": "one grain", "array": "125 grains"}


def draw_rates(comparisons: Sequence[Comparison], file: Path) -> None:
    """Draw the rates of both codes on every body, and write it as PNG."""
    figure, axes = new_figure(len(comparisons))
    for axis, comparison in zip(axes, comparisons, strict=True):
        _draw_bars(axis, comparison)
    save(figure, file)


def draw_speed(run: FirstRun, file: Path) -> None:
    """Draw the speed along a run, and write it as PNG."""
    figure, axes = new_figure(1)
    _draw_speed(axes[0], run)
    save(figure, file)


def new_figure(panels: int, width: float = 4.2, height: float = 3.4) -> tuple[Any, Any]:
    """Return a figure and its panels, side by side."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width * panels, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.subplots(1, panels, squeeze=False)[0]


def save(figure: Any, file: Path) -> None:
    """Write a figure as PNG."""
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=130)


def _draw_bars(axis: Any, comparison: Comparison) -> None:
    rates = {f"Clast\n{MODELS[model]}": comparison.rate(model).median for model in comparison.clast}
    if comparison.peer is not None:
        rates[f"{PEER}\nbpm/rotational"] = spread(comparison.peer.rate).median
    colours = [PEER_COLOUR if name.startswith(PEER) else CLAST_COLOUR for name in rates]
    bars = axis.bar(list(rates), list(rates.values()), color=colours, width=0.65)
    axis.bar_label(bars, [number(rate) for rate in rates.values()], padding=2)
    body = comparison.body
    size = f"{number(body.particles)} particles, {number(body.bonds)} bonds"
    axis.set_title(f"{TITLES[body.name]}: {size}", fontsize=10)
    axis.set_ylabel("steps per CPU second")
    axis.margins(y=0.12)
    axis.spines[["top", "right"]].set_visible(False)
    axis.tick_params(axis="x", labelsize=8)


def _draw_speed(axis: Any, run: FirstRun) -> None:
    rows = run.told["speed"]
    strain = [0.0, *(100.0 * row["strain"] for row in rows)]
    rate = [row["steps_per_s"] for row in rows]
    axis.stairs(rate, strain, color=CLAST_COLOUR, linewidth=1.8, baseline=None)
    axis.set_ylim(0.0, 1.12 * max(rate))
    axis.set_xlabel("strain in %")
    axis.set_ylabel("steps per CPU second")
    axis.set_title("Clast while the ready scene is crushed", fontsize=10)
    axis.spines[["top", "right"]].set_visible(False)
