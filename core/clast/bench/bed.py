"""Section: the ready oedometer scene on one thread and on two."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from clast.bench.measure import Spread, number, say, spread, worker
from clast.bench.places import scene_file
from clast.bench.section import Effort, Section, Task
from clast.bench.tables import table

SMALL, LARGE = "oedometer_small", "oedometer"
THREADS = (1, 2)
FIRST, ROUNDS = 600, 7
STEPS = {SMALL: 600, LARGE: 60}
TARGET, GAIN = 10.0, 1.7
"""Steps per s of the large bed on one thread, and what two threads must bring."""


@dataclass
class Row:
    """Steps per s of wall time with a number of threads."""

    threads: int
    per_s: Spread


@dataclass
class Bed:
    """A bed in its elastic phase; memory of the process that holds it once for every number of threads, in MB."""

    scene: str
    particles: int
    bonds: int
    rows: list[Row]
    gain: Spread | None
    memory_MB: float


def measure(task: Task) -> Bed:
    """Advance one copy of the bed for each number of threads, by turns in one process: the small one on one thread."""
    full = task.effort is Effort.FULL
    name, threads = (LARGE, THREADS) if full else (SMALL, THREADS[:1])
    say(f"bed: {name}")
    child, told = worker("compare_threads", scene_file(name), FIRST, STEPS[name], ROUNDS, *threads)
    seconds = {int(each): values for each, values in told["seconds"].items()}
    rows = [Row(each, spread([1.0 / value for value in seconds[each]])) for each in threads]
    gain = spread([one / two for one, two in zip(seconds[1], seconds[2], strict=True)]) if full else None
    return Bed(name, told["particles"], told["bonds"], rows, gain, child.memory)


def text(found: Bed, pictures: Path) -> str:
    """Return the section."""
    told = (
        f"`configs/{found.scene}.yaml`, grains of three size classes in a tube: {number(found.particles)} primaries, "
        f"{number(found.bonds)} bonds, Model 3, friction 4. From step {FIRST} on, {ROUNDS} turns; wall time with "
        "searches for neighbours, without output."
    )
    rows = [[str(row.threads), f"{row.per_s}", number(1e9 / (row.per_s.median * found.bonds))] for row in found.rows]
    parts = ["## A bed of grains", told, table(("threads", "steps per s", "ns per bond and step"), rows)]
    if found.gain is not None:
        fast = "met" if found.rows[0].per_s.median >= TARGET else "**missed**"
        gained = "met" if found.gain.median >= GAIN else "**missed**"
        parts.append(
            f"Aims: {TARGET:g} steps per s on one thread ({fast}), {GAIN:g} times as many on two "
            f"({found.gain.median:.2f}: {gained})."
        )
    return "\n\n".join(parts)


SECTION = Section(
    "bed", "the ready oedometer scene; with --full the large one, on one thread and two", Bed, measure, text
)
