"""The picture: error or end of the scenes whose step is varied, against the step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tests.stability.entry import ACCURATE, GARBAGE, REFUSED, STOPPED, Verdict
from tests.stability.matrix import GROUPS

PANELS = {
    "step_bonds": ("time step / true limit", "change of energy"),
    "step_contacts": ("time step / true limit", "change of energy"),
    "impacts": ("time step / duration of the impact", "error of restitution"),
}
ENDS = {REFUSED: (3e1, "#b8b8b8", "s"), STOPPED: (3.0, "#c44e52", "X"), GARBAGE: (0.3, "black", "*")}
LABELS = {REFUSED: "refused", STOPPED: "stopped with allow_unstable", GARBAGE: "silent garbage"}


def draw(found: Mapping[str, Sequence[Verdict]], file: Path) -> None:
    """Draw one panel a group and write it as PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12.0, 3.8), layout="constrained")
    FigureCanvasAgg(figure)
    titles = {group.name: group.title for group in GROUPS}
    for axis, (name, labels) in zip(figure.subplots(1, len(PANELS), sharey=True), PANELS.items(), strict=True):
        draw_group(axis, [verdict for verdict in found[name] if verdict.entry.x > 0.0])
        axis.set(title=titles[name], xlabel=labels[0], ylabel=labels[1])
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=130)


def draw_group(axis: Any, verdicts: Sequence[Verdict]) -> None:
    """Draw the errors of a group, and how the scenes without one ended."""
    good = [(v.entry.x, v.answer.error, v.answer.bound) for v in verdicts if v.kind == ACCURATE and v.answer]
    axis.plot([x for x, _, _ in good], [error for _, error, _ in good], "o-", color="#1f6f8b", label="error")
    axis.axhline(good[0][2], color="#1f6f8b", linewidth=0.8, linestyle="--", label="bound")
    for kind, (height, colour, mark) in ENDS.items():
        at = [v.entry.x for v in verdicts if v.kind == kind]
        if at:
            axis.plot(at, [height] * len(at), mark, color=colour, label=LABELS[kind], clip_on=False)
    axis.set(xscale="log", yscale="log", ylim=(1e-9, 1e2))
    axis.spines[["top", "right"]].set_visible(False)
    axis.legend(fontsize=8, frameon=False, loc="upper left")
