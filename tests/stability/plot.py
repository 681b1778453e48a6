"""The picture: error or end of the scenes whose step is varied, against the step as a share of the true limit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from tests.stability.entry import ACCURATE, GARBAGE, REFUSED, STOPPED, Verdict
from tests.stability.matrix import GROUPS

PANELS = ("step_bonds", "step_contacts", "step_damped")
ENDS = {REFUSED: (3e1, "#b8b8b8", "s"), STOPPED: (1e1, "#c44e52", "X"), GARBAGE: (1e0, "black", "*")}


def draw(found: Mapping[str, Sequence[Verdict]], file: Path) -> None:
    """Draw one panel a group and write it as PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(12.0, 3.6), layout="constrained")
    FigureCanvasAgg(figure)
    titles = {group.name: group.title for group in GROUPS}
    for axis, name in zip(figure.subplots(1, len(PANELS), sharey=True), PANELS, strict=True):
        draw_group(axis, found[name], titles[name])
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=130)


def draw_group(axis: Any, verdicts: Sequence[Verdict], title: str) -> None:
    """Draw the errors of a group below the limit, and how it ended above."""
    good = [(v.entry.x, max(v.answer.error, 1e-16)) for v in verdicts if v.kind == ACCURATE and v.answer]
    axis.plot(*zip(*good, strict=True), "o", color="#1f6f8b", label="error")
    for kind, (height, colour, mark) in ENDS.items():
        at = [v.entry.x for v in verdicts if v.kind == kind]
        if at:
            axis.plot(at, [height] * len(at), mark, color=colour, label=kind, clip_on=False)
    axis.axvline(1.0, color="grey", linewidth=1.0)
    axis.set(xscale="log", yscale="log", title=title, xlabel="time step / true limit", ylim=(1e-16, 1e2))
    axis.spines[["top", "right"]].set_visible(False)
    axis.legend(fontsize=8, frameon=False)
