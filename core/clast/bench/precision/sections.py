"""Sections: one for every problem, its picture, its claim and its orders."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from clast.bench.precision import lammps
from clast.bench.precision.ahead import compile_ahead
from clast.bench.precision.claim import cpu_for, gain, gains, sentence, share, times
from clast.bench.precision.draw import draw
from clast.bench.precision.problem import Problem
from clast.bench.precision.problems import PROBLEMS
from clast.bench.precision.sweep import Series, Swept, sweep
from clast.bench.section import Section, Task
from clast.bench.tables import table
from clast.errors import ClastError

GOAL = 10.0


def measure(problem: Problem, task: Task) -> Swept:
    """Try every way of Clast, then the peer where it can compute the same."""
    compile_ahead(problem, task)
    found = Swept(problem.own, problem.copies, problem.end, problem.fine, sweep(problem, task))
    if problem.name not in lammps.COMPUTED:
        return found
    if task.peer is None:
        found.no_peer = task.no_peer
        return found
    try:
        found.series.append(lammps.sweep(problem, task))
    except ClastError as error:
        found.no_peer = f"LAMMPS could not compute this: {str(error).splitlines()[-1]}."
    return found


def text(problem: Problem, found: Swept, pictures: Path) -> str:
    """Return the section."""
    picture = f"error_{problem.name}.png"
    draw(problem, found, pictures / picture)
    found_gain = gain(found)
    error = None if found_gain is None else found_gain.error
    parts = [
        f"### {problem.title}",
        f"{problem.text} Scene: `configs/benchmarks/{problem.name}.yaml`. {sentence(found_gain)}.{verdict(found)}",
        f"![Error against CPU time: {problem.title}]({pictures.name}/{picture})",
        orders(found, error),
        notes(problem, found),
    ]
    return "\n\n".join(parts)


def verdict(found: Swept) -> str:
    """Say whether the goal beside the peer is reached."""
    got = gain(found)
    if found.no_peer:
        return f" {found.no_peer}"
    if got is None or got.slow.program == "Clast":
        return ""
    asked = f" Asked for beside LAMMPS on this scene or the other that it can compute: {GOAL:g} times"
    if got.slow.order is None:
        return f"{asked}; not decided here: too few steps to tell how the error of LAMMPS falls."
    ratios = gains(found)
    low, high = min(each.times for each in ratios), max(each.times for each in ratios)
    span = f"{share(max(each.error for each in ratios))} to {share(min(each.error for each in ratios))}"
    reached = [each.error for each in ratios if each.times >= GOAL]
    met = f"met from an error of {share(max(reached))} down" if reached else "**missed**"
    return f" Over the errors that both reach, {span}, it is {times(low)} to {times(high)} times.{asked}; here {met}."


def orders(found: Swept, error: float | None) -> str:
    """Return the table of orders, with the cost of the common error."""
    head = ["", "order fitted", "order in theory", "least error", "µs per step"]
    if error is not None:
        head.append(f"CPU s at {share(error)}")
    return table(head, [_row(series, error)[: len(head)] for series in found.series])


def _row(series: Series, error: float | None) -> list[str]:
    if not series.points:
        return [series.label, "", "", series.problem, "", ""]
    last = series.points[-1]
    cost = None if error is None else cpu_for(series, error)
    return [
        series.label,
        "" if series.order is None else f"{series.order:.2f}",
        "" if series.expected is None else f"{series.expected:g}",
        f"{min(p.error for p in series.points):.1e}",
        f"{1e6 * last.cpu_s / last.steps:.1f}",
        "" if cost is None else f"{cost:.2g}",
    ]


def notes(problem: Problem, found: Swept) -> str:
    """Say what the errors are against, and how well that is known."""
    own = [series for series in found.series if series.program == "Clast"]
    floors = ", ".join(sorted({f"{series.floor:.0e}" for series in own}))
    copies = f" Time is measured on {found.copies} copies side by side." if found.copies > 1 else ""
    told = (
        f"Steps: {', '.join(str(p.steps) for p in max(own, key=lambda s: len(s.points)).points)}; the reference takes "
        f"{found.fine} with the scene's own integrator and each kinematics' own physics. It is known to {floors} (its "
        f"difference from one with half the steps); errors below three times that are not drawn.{copies}"
    )
    if any(series.program != "Clast" for series in found.series):
        told += f" The reference of LAMMPS is LAMMPS itself with {lammps.FINER} times its finest steps."
    missing = [f"{series.label}: {series.problem}" for series in found.series if series.problem and series.points]
    return "\n\n".join([told, *missing])


SECTIONS = tuple(
    Section(
        each.name, f"error against CPU time: {each.title.lower()}", Swept, partial(measure, each), partial(text, each)
    )
    for each in PROBLEMS
)
