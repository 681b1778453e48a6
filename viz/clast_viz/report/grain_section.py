"""The section on grains: what became of a bed of them, of one run or of several beside each other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from clast.errors import RunError
from clast.granular.analysis import Granular, analyse
from clast.granular.coordination import TOLERANCE
from clast.granular.damage import CRUSHED, DAMAGED, INTACT
from clast_viz.curves import has_compression
from clast_viz.report import chain_chart, crack_chart, grain_charts
from clast_viz.report.grain_charts import Shown
from clast_viz.report.section import Drawer, Member, Section, left_out

SIZES = (
    "Size: diameter of the sphere with a fragment's volume, its pores included (those of its grain as packed). "
    "Finer ones hold the share of the mass that is drawn."
)
BROKEN = (
    "Crushed: the largest fragment holds less than half of the grain's mass. "
    "Damaged: bonds broke, but at least half hangs together. Intact: no bond broke."
)
FILLED = "Filled by primaries (solid line), and by fragments with their pores (dashed), overlaps not subtracted."
TOUCHING = f"Grains touch where primaries of both are at most {100.0 * TOLERANCE:g} % of a primary's diameter apart."


def grain_section(runs: Sequence[Member], draw: Drawer) -> Section | None:
    """Return the section on grains, or nothing where no run has more than one."""
    beds = [member for member in runs if member.run.grain.max(initial=-1) > 0]
    if not beds:
        return None
    section = Section("Grains", overlaid=len(runs) > 1)
    section.notes += left_out([m for m in runs if m not in beds], runs, "not shown here, as it has one grain or none")
    shown = []
    for member in beds:
        try:
            shown.append(Shown(analyse(member.run), member.run, member.label, member.style))
        except RunError as error:
            section.notes.append(str(error))
    if len(shown) > 1:
        section.notes.append("Thin faint lines: at the start. Full lines: at the end.")
    if shown:
        _draw_all(shown, draw, section)
        section.head = ["", *(each.label if len(shown) > 1 else "at the start → at the end" for each in shown)]
        table = [[name, *(tell(each.found) for each in shown)] for name, tell in ROWS.items()]
        section.table = [row for row in table if any(row[1:])]
    return section


def _draw_all(shown: Sequence[Shown], draw: Drawer, section: Section) -> None:
    several = len(shown) > 1
    followed = [each for each in shown if len(each.found.history["frame"]) > 1]
    if followed:
        bulk = partial(grain_charts.bulk, followed)
        section.charts.append(draw("What becomes of the grains", bulk, BROKEN))
    cracked = [each for each in shown if len(each.run.cracks["bond"])]
    for each in cracked:
        title = "Where and when bonds broke" + (f": {each.label}" if several else "")
        chart = partial(crack_chart.crack_chart, each, crack_chart.most_in_one_place(cracked))
        section.charts.append(draw(title, chart, crack_chart.CAPTION))
    for each in shown:
        _draw_chains(each, draw, section)
    section.charts.append(draw("Grading by mass", partial(grain_charts.gradings, shown), SIZES))
    section.charts.append(draw("Bonds broken per grain", partial(grain_charts.damages, shown)))
    walled = [each for each in shown if each.found.bed.section is not None]
    tubes = [each for each in shown if each.found.bed.tube is not None]
    if walled:
        section.charts.append(draw("Solid fraction over the height", partial(grain_charts.over_height, walled), FILLED))
    if tubes:
        section.charts.append(draw("Solid fraction near the wall", partial(grain_charts.near_wall, tubes), FILLED))
    section.charts.append(draw("Grains in contact with a grain", partial(grain_charts.coordination, shown), TOUCHING))
    over_height = partial(grain_charts.coordination_over_height, shown)
    section.charts.append(draw("Coordination number over the height", over_height))
    beds = [Member(each.run, each.label, each.style) for each in shown]
    free = [bed for bed, each in zip(beds, shown, strict=True) if each.found.bed.section is None]
    section.notes += left_out(free, beds, "no porosities and solid fractions, as no walls around the bed are named")


def _draw_chains(shown: Shown, draw: Drawer, section: Section) -> None:
    found = chain_chart.network(shown.run)
    if found is None:
        return
    when = f"{found.strain:.1%} strain" if has_compression(shown.run) else f"{found.time:.4g} s"
    title = f"Force chains at {when}" + (f": {shown.label}" if section.overlaid else "")
    caption = chain_chart.sentence(found) + chain_chart.CAPTION
    section.charts.append(draw(title, partial(chain_chart.chain_chart, shown, found), caption))


def _change(column: str, form: Callable[[float], str]) -> Callable[[Granular], str]:
    """Return what tells the first and the last value of a column of the history."""

    def tell(found: Granular) -> str:
        first, last = found.history[column][[0, -1]].tolist()
        return "" if np.isnan(last) else f"{form(first)} → {form(last)}"

    return tell


def _last(column: str, form: Callable[[float], str]) -> Callable[[Granular], str]:
    def tell(found: Granular) -> str:
        last = float(found.history[column][-1])
        return "" if np.isnan(last) else form(last)

    return tell


def _millimetres(value: float) -> str:
    return f"{1e3 * value:.3g} mm"


def _share(value: float) -> str:
    return f"{100.0 * value:.1f} %"


def _states(found: Granular) -> str:
    hurt = found.moments[-1].damage
    return ", ".join(f"{hurt.number(state)} ({hurt.number(state) / len(hurt.state):.0%})" for state in STATES)


def _touching(found: Granular) -> str:
    first, last = (float(found.moments[k].coordination.mean()) for k in (0, -1))
    return f"{first:.2f} → {last:.2f}"


STATES = (INTACT, DAMAGED, CRUSHED)
ROWS: dict[str, Callable[[Granular], str]] = {
    "grains": lambda found: str(found.grains.count),
    "intact, damaged, crushed at the end": _states,
    "damage D, mean over the grains": _last("damage", lambda value: f"{value:.3f}"),
    "fragments": _change("fragments", lambda value: f"{value:.0f}"),
    "d10": _change("d10_m", _millimetres),
    "d50": _change("d50_m", _millimetres),
    "d90": _change("d90_m", _millimetres),
    "relative breakage B_r (Hardin)": _last("hardin", lambda value: f"{value:.3f}"),
    "breakage index B (Einav)": _last("einav", lambda value: f"{value:.3f}"),
    "porosity, pores of grains included": _change("porosity", _share),
    "porosity between grains and fragments": _change("porosity_between", _share),
    "coordination number": _touching,
}
"""What the table of the section tells, by what stands before it."""
