"""Section: how long a user waits, and what output costs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from clast.bench import plot, startup, tables
from clast.bench.section import Effort, Section, Task
from clast.bench.startup import FirstRun, Wait

PICTURE = "benchmarks_crush.png"


@dataclass
class Waiting:
    """The first run of the ready scene, and what is waited for once caches are filled."""

    run: FirstRun
    waits: list[Wait]


def measure(task: Task) -> Waiting:
    """Run the ready scene where nothing was compiled, to 3 % strain unless all is asked for."""
    return Waiting(*startup.measure_start(2 if task.effort is Effort.QUICK else 3, task.effort is not Effort.FULL))


def text(found: Waiting, pictures: Path) -> str:
    """Return the section."""
    run = found.run
    plot.draw_speed(run, pictures / PICTURE)
    scope = " to 3 % strain only" if run.short else ""
    size = f"{run.told['particles']} particles, {run.told['bonds']} bonds"
    first = (
        f"One run of `configs/crush_grain.yaml` ({size}){scope}, with default output, where nothing had been compiled "
        "before; times from the first step on."
    )
    parts = [
        "## How long a user waits",
        tables.waits(found.waits, run),
        "### What output costs",
        first,
        tables.output(run),
        "### Speed while the grain breaks",
        "The same run, in ten parts of equal numbers of steps; output is not counted.",
        f"![Speed during the run]({pictures.name}/{PICTURE})",
        tables.crush_speed(run),
    ]
    return "\n\n".join(parts)


SECTION = Section("start", "start-up, compilation, output, memory of a run", Waiting, measure, text)
