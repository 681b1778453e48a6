"""The page: what was measured, where, and each section's tables and pictures."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from clast.bench.machine import Machine
from clast.bench.section import Section
from clast.bench.store import Record
from clast.bench.suite import ERROR_AGAINST_TIME

BUSY = 0.4
PRECISION = """\
## Error against run time

Every installed integrator and bond kinematics computes the same scene with ever smaller steps. Each dot is a run: \
what it cost in CPU seconds of the step loop, and how far it is from a reference with a far smaller step, always at \
the same instants. Lower left is better. A part that a plugin brings appears here by being installed. The order p is \
fitted to error ∝ Δtᵖ; in theory it is the scheme's own order on an oscillator with the scene's kind of damping, or \
what the kinks of the forces leave of it: 1.25 where Tsuji's damping sets in at first touch."""


def page(found: Sequence[tuple[Section, Record]], pictures: Path) -> str:
    """Return the page as Markdown; sections whose measurement failed say so."""
    parts = ["# Benchmarks", *opening([record for _, record in found])]
    headed = False
    for section, record in found:
        if section in ERROR_AGAINST_TIME and not headed:
            parts.append(PRECISION)
            headed = True
        if record.result is None:
            parts.append(f"### Not measured: {section.title}\n\n{record.problem}")
        else:
            parts.append(section.text(record.result, pictures))
    return "\n\n".join(parts) + "\n"


def opening(records: Sequence[Record]) -> list[str]:
    """Say by which commands and on which machine the numbers were measured."""
    origins: dict[tuple[str, str, str, int], list[Record]] = {}
    for record in records:
        machine = record.machine
        origins.setdefault((record.command, machine.processor, machine.software, machine.cores), []).append(record)
    if not origins:
        return ["Nothing is measured yet: `clast bench`."]
    one = len(origins) == 1
    told = "Every number on this page was measured by one command on one machine:" if one else "Measured by:"
    lines = [told]
    for (command, processor, software, cores), those in origins.items():
        which = "" if one else f" ({', '.join(record.section for record in those)})"
        minutes = sum(record.seconds for record in those) / 60.0
        place = f"- processor: {processor}, {cores} cores\n- {software}"
        lines.append(f"- command: `{command}`{which}, {minutes:.0f} minutes\n{place}")
    return [*lines, *cautions(records)]


def cautions(records: Sequence[Record]) -> list[str]:
    """Say what makes the numbers rough."""
    parts = []
    quick = [record.section for record in records if record.effort == "quick"]
    if quick:
        parts.append(f"Quick, so rough: {', '.join(quick)}. Few repeats of short windows.")
    busiest = max((busy(record.machine) for record in records), default=0.0)
    if busiest > BUSY:
        parts.append(
            f"Other programs were running (up to {busiest:.1f} processes per core when a section began): wall times "
            "are upper bounds, rates are too low; ratios hold better, as what is compared took turns."
        )
    return parts


def busy(machine: Machine) -> float:
    """Return the load per core before the section began."""
    return machine.busy
