"""Sections of a report with charts: what is drawn of which runs, and a sentence where there is nothing to draw."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import count
from typing import Any, NamedTuple

import numpy as np
from markupsafe import Markup

from clast.errors import RunError
from clast.results.curves import energies
from clast.results.run import Run
from clast_viz.compare import Line, line_style
from clast_viz.curves import has_compression
from clast_viz.energy import closing, unit_of
from clast_viz.report import charts
from clast_viz.report.pieces import Pieces, pieces
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


def chart_sections(runs: Sequence[Member]) -> Iterator[Section]:
    """Yield the sections with charts, in the order of the page."""
    if runs:
        draw = Drawer()
        yield _curves(runs, draw)
        yield _fragments(runs, draw)
        yield _energy(runs, draw)
        yield _cracks(runs, draw)


def _curves(runs: Sequence[Member], draw: Drawer) -> Section:
    section = Section("Curves", overlaid=len(runs) > 1)
    pressed = [member for member in runs if has_compression(member.run)]
    others = [member for member in runs if member not in pressed]
    if pressed:
        lines = partial(charts.stress_strain, _lines(pressed))
        section.charts.append(draw("Stress and bonds broken over strain", lines))
    section.notes += _left_out(
        others, runs, "no stress–strain curve, as the scene has no compression, or no two samples were taken"
    )
    bonded = [m for m in others if len(m.run.bond_ends) and len(m.run.curves["time_s"]) > 1]
    if bonded:
        section.charts.append(draw("Bonds broken over time", partial(charts.bonds_over_time, _lines(bonded))))
    return section


def _lines(runs: Sequence[Member]) -> list[Line]:
    return [Line(member.run, "", member.style) for member in runs]  # the page itself has the legend


def _left_out(without: Sequence[Member], runs: Sequence[Member], why: str) -> list[str]:
    """Return the sentence about runs that a chart does not show, by name where there are others."""
    if not without:
        return []
    names = ", ".join(member.label for member in without)
    return [f"{why[0].upper()}{why[1:]}." if len(runs) == 1 else f"{names}: {why}."]


def _fragments(runs: Sequence[Member], draw: Drawer) -> Section:
    section = Section("Fragments", overlaid=len(runs) > 1)
    found: list[tuple[Member, Pieces]] = []
    for member in runs:
        try:
            of_run = pieces(member.run)
        except RunError as error:
            section.notes.append(str(error))
            continue
        if of_run is not None:
            found.append((member, of_run))
    without = [member for member in runs if not (len(member.run.bond_ends) and member.run.n_frames)]
    section.notes += _left_out(without, runs, "no fragments, as there are no bonds or no frames were kept")
    followed = [(each, of_run) for each, of_run in found if len(of_run.time) > 1]
    for over_strain in (True, False):
        alike = [(of_run, each.style) for each, of_run in followed if has_compression(each.run) == over_strain]
        if alike:
            history = partial(charts.fragments, alike, over_strain)
            section.charts.append(draw("Number of fragments, and the largest one", history))
    if found:
        pairs = [(of_run, member.style) for member, of_run in found]
        caption = "Diameter: that of a sphere with the volume of the particles that still hang together by bonds."
        section.charts.append(draw("Sizes of fragments in the last frame", partial(charts.sizes, pairs), caption))
    return section


def _energy(runs: Sequence[Member], draw: Drawer) -> Section:
    section = Section("Energy")
    booked = [member for member in runs if energies(member.run.curves)]
    drawn = [member for member in booked if len(member.run.curves["time_s"]) > 1]
    for member in drawn:
        title = "Where the work stays" + (f": {member.label}" if len(runs) > 1 else "")
        caption = f"Nothing is computed as the rest: {closing(energies(member.run.curves))}."
        section.charts.append(draw(title, partial(charts.energy, member.run), caption))
    off = [member for member in runs if member not in booked]
    section.notes += _left_out(off, runs, "no energies, as the ledger was off (output.ledger: true books them)")
    begun = [member for member in booked if member not in drawn]
    section.notes += _left_out(begun, runs, "no energies, as no two samples were taken")
    return section


def _cracks(runs: Sequence[Member], draw: Drawer) -> Section:
    section = Section("Cracks")
    broken = [member for member in runs if len(member.run.cracks["mode"])]
    section.notes += _left_out([m for m in runs if m not in broken], runs, "no bond broke")
    for member in broken:
        title = "Bonds broken, by mode" + (f": {member.label}" if len(runs) > 1 else "")
        section.charts.append(draw(title, partial(charts.cracks, member.run)))
    section.head = ["mode", *(member.label if len(runs) > 1 else "bonds broken, energy in them" for member in broken)]
    modes = dict.fromkeys(mode for member in broken for mode in member.run.crack_modes)
    table = [[mode, *(_of_mode(member.run, mode) for member in broken)] for mode in modes]
    section.table = [row for row in table if any(row[1:])]
    return section


def _of_mode(run: Run, mode: str) -> str:
    """Return how many bonds broke by a mode, their share, and the energy that was in them; empty where none did."""
    chosen = run.cracks["mode"] == run.crack_modes.index(mode) if mode in run.crack_modes else np.zeros(0, bool)
    number = int(np.count_nonzero(chosen))
    if not number:
        return ""
    energy = float(np.nansum(run.cracks["energy"][chosen]))
    factor, unit = unit_of(abs(energy))
    return f"{number} ({number / len(chosen):.0%}), {factor * energy:.3g} {unit}"
