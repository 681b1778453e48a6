"""Sections of a report with charts: what is drawn of which runs, and a sentence where there is nothing to draw."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from clast.errors import RunError
from clast.results.curves import energies
from clast.results.run import Run
from clast_viz.compare import Line
from clast_viz.curves import has_compression
from clast_viz.energy import closing, unit_of
from clast_viz.report import charts
from clast_viz.report.grain_section import grain_section
from clast_viz.report.pieces import Pieces, pieces
from clast_viz.report.section import Drawer, Member, Section, left_out
from clast_viz.report.side_chart import has_side, side


def chart_sections(runs: Sequence[Member]) -> Iterator[Section]:
    """Yield the sections with charts, in the order of the page."""
    if runs:
        draw = Drawer()
        yield _curves(runs, draw)
        yield _fragments(runs, draw)
        yield _energy(runs, draw)
        yield _cracks(runs, draw)
        grains = grain_section(runs, draw)
        if grains is not None:
            yield grains


def _curves(runs: Sequence[Member], draw: Drawer) -> Section:
    section = Section("Curves", overlaid=len(runs) > 1)
    pressed = [member for member in runs if has_compression(member.run)]
    others = [member for member in runs if member not in pressed]
    if pressed:
        lines = partial(charts.stress_strain, _lines(pressed))
        section.charts.append(draw("Stress and bonds broken over strain", lines))
    around = [member for member in pressed if has_side(member.run)]
    if around:
        caption = "K, the lateral pressure coefficient, is the stress on the side over the mean of those on the plates."
        title = "Stress on plates and side, and lateral pressure coefficient"
        section.charts.append(draw(title, partial(side, _lines(around)), caption))
    section.notes += left_out(
        others, runs, "no stress–strain curve, as the scene has no compression, or no two samples were taken"
    )
    bonded = [m for m in others if len(m.run.bond_ends) and len(m.run.curves["time_s"]) > 1]
    if bonded:
        section.charts.append(draw("Bonds broken over time", partial(charts.bonds_over_time, _lines(bonded))))
    return section


def _lines(runs: Sequence[Member]) -> list[Line]:
    return [Line(member.run, "", member.style) for member in runs]  # the page itself has the legend


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
    section.notes += left_out(without, runs, "no fragments, as there are no bonds or no frames were kept")
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
    section.notes += left_out(off, runs, "no energies, as the ledger was off (output.ledger: true books them)")
    begun = [member for member in booked if member not in drawn]
    section.notes += left_out(begun, runs, "no energies, as no two samples were taken")
    return section


def _cracks(runs: Sequence[Member], draw: Drawer) -> Section:
    section = Section("Cracks")
    broken = [member for member in runs if len(member.run.cracks["mode"])]
    section.notes += left_out([m for m in runs if m not in broken], runs, "no bond broke")
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
