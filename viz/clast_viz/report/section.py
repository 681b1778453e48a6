"""Section: a part of a page with charts, and what it is drawn from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import count
from typing import Any, NamedTuple

from markupsafe import Markup

from clast.results.run import Run
from clast_viz.compare import line_style
from clast_viz.report import charts
from clast_viz.report.svg import inline_svg


class Chart(NamedTuple):
    """A drawing, what stands over it, and what under it."""

    title: str
    svg: Markup
    caption: str


@dataclass
class Section:
    """Part of a page.

    Attributes
    ----------
    title : str
    charts : list of Chart
    notes : list of str
        Why something is not drawn.
    overlaid : bool
        Whether the lines of several runs lie over each other, so that a reader needs to know which is whose.
    head, table : sequences
        A table under the charts; the first cell of each row names it.
    """

    title: str
    charts: list[Chart] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    overlaid: bool = False
    head: Sequence[str] = ()
    table: Sequence[Sequence[str]] = ()

    @property
    def anchor(self) -> str:
        """Name to link to."""
        return self.title.lower().replace(" ", "-")


class Member(NamedTuple):
    """A run of the report that can be read, its label, and how its lines are drawn."""

    run: Run
    label: str
    style: dict[str, str]


class Drawer:
    """Draws charts whose ids differ."""

    def __init__(self) -> None:
        self._numbers = count(1)

    def __call__(self, title: str, draw: Callable[[], Any], caption: str = "") -> Chart:
        """Draw one."""
        return Chart(title, inline_svg(draw, title, f"chart{next(self._numbers)}"), caption)


def members(readable: Sequence[tuple[Run, str]]) -> list[Member]:
    """Give every run its line: a run alone is drawn as its own figures draw it."""
    if len(readable) == 1:
        return [Member(*readable[0], charts.SINGLE)]
    return [Member(run, label, line_style(k)) for k, (run, label) in enumerate(readable)]


def left_out(without: Sequence[Member], runs: Sequence[Member], why: str) -> list[str]:
    """Return the sentence about runs that a chart does not show, by name where there are others."""
    if not without:
        return []
    names = ", ".join(member.label for member in without)
    return [f"{why[0].upper()}{why[1:]}." if len(runs) == 1 else f"{names}: {why}."]
