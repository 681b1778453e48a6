"""Section: how long neighbour searches take, by the number of particles and by how much their sizes differ."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from clast.bench.measure import say
from clast.bench.plot import new_figure, save
from clast.bench.precision.draw import COLOURS
from clast.bench.section import Effort, Section, Task
from clast.bench.tables import table

Floats = NDArray[np.float64]

COUNTS = {Effort.QUICK: (2_000,), Effort.USUAL: (1_000, 20_000), Effort.FULL: (1_000, 20_000, 200_000)}
RATIOS = (1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0)
MOST_PAIRS_TESTED = 2e8
"""More pairs than these are not tested one by one: that takes minutes, and tells nothing new."""
REPEATS, PICTURE = 3, "search.png"


@dataclass
class Row:
    """One search: particles, largest over smallest size, mean of pairs found a particle, CPU s; 0 where left out."""

    search: str
    particles: int
    ratio: float
    pairs: float
    cpu_s: float


def sample(count: int, ratio: float) -> tuple[Floats, Floats]:
    """Return positions and reaches of particles whose volume is the same in every class of sizes, thrown at random."""
    draw = np.random.default_rng(1)
    share = draw.uniform(0.0, 1.0, count)
    reach = (1.0 - share * (1.0 - ratio**-3.0)) ** (-1.0 / 3.0)
    side = (8.0 / 3.0 * np.pi * np.sum(reach**3)) ** (1.0 / 3.0)
    return draw.uniform(0.0, side, (count, 3)), 1.05 * reach


def measure(task: Task) -> list[Row]:
    """Clock every search that is installed."""
    found = []
    for count in COUNTS[task.effort]:
        for ratio in RATIOS:
            found += [
                clocked(task, name, *sample(count, ratio), ratio) for name in task.registry.names("neighbour_search")
            ]
        say(f"search: {count} particles")
    return found


def clocked(task: Task, name: str, position: Floats, reach: Floats, ratio: float) -> Row:
    """Return the least CPU time of some repeats."""
    search, count = task.registry.get("neighbour_search", name).part.find_pairs, len(reach)
    if name == "brute_force" and count * count > MOST_PAIRS_TESTED:
        return Row(name, count, ratio, 0.0, 0.0)
    search(position[:9], reach[:9])  # compiles
    pairs, times = 0, []
    for _ in range(REPEATS):
        begun = time.process_time()
        pairs = len(search(position, reach))
        times.append(time.process_time() - begun)
    return Row(name, count, ratio, pairs / count, min(times))


def text(found: list[Row], pictures: Path) -> str:
    """Return the section."""
    draw(found, pictures / PICTURE)
    names = list(dict.fromkeys(row.search for row in found))
    rows = []
    for count, ratio in dict.fromkeys((row.particles, row.ratio) for row in found):
        here = {row.search: row for row in found if (row.particles, row.ratio) == (count, ratio)}
        cells = [f"{1e9 * here[name].cpu_s / count:.0f}" if here[name].cpu_s > 0.0 else "" for name in names]
        rows.append([f"{count:,}", f"{ratio:g}", f"{max(row.pairs for row in here.values()):.1f}", *cells])
    told = (
        "Particles at random whose total volume is the same in every class of sizes, so that most are small. All "
        "searches find the same pairs in the same order; `auto` takes the one that has less to do by its count of "
        "tests."
    )
    head = ("particles", "largest : smallest", "pairs a particle", *(f"{name}, ns a particle" for name in names))
    return "\n\n".join(
        ["## Neighbour search", told, f"![Neighbour searches]({pictures.name}/{PICTURE})", table(head, rows)]
    )


def draw(found: list[Row], file: Path) -> None:
    """Draw the time of a search of the most particles against the ratio of sizes."""
    figure, (axis,) = new_figure(1, 6.4, 3.6)
    most = max(row.particles for row in found)
    for k, name in enumerate(dict.fromkeys(row.search for row in found)):
        rows = [row for row in found if row.search == name and row.particles == most and row.cpu_s > 0.0]
        times = [1e9 * row.cpu_s / most for row in rows]
        axis.plot([row.ratio for row in rows], times, "o-", color=COLOURS[k % len(COLOURS)], label=name)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlabel("largest size over smallest")
    axis.set_ylabel(f"CPU ns a particle, {most:,} particles")
    axis.spines[["top", "right"]].set_visible(False)
    axis.legend(frameon=False)
    save(figure, file)


SECTION = Section("search", "neighbour searches against the spread of sizes", list[Row], measure, text)
