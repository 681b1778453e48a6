"""Section: speed and memory against the size of the scene, with one thread and two."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from clast.bench.measure import BenchmarkError, number, say, worker
from clast.bench.plot import new_figure, save
from clast.bench.scenes import GRAIN_DIAMETER, SPACING, Body, base_grain, scene, write_scene, write_tables
from clast.bench.section import Effort, Section, Task
from clast.bench.tables import table

GRAINS_PER_SIDE = {Effort.QUICK: (1, 2), Effort.USUAL: (1, 2, 4), Effort.FULL: (1, 2, 4, 8, 14)}
STEPS_OF_PARTICLES = 4e6
FIRST = 130
"""Step from which is measured: after the first looks at the stable step, which come soon and then ever more rarely."""
THREADS = (1, 2)
BYTES_PER_PARTICLE = 6000.0
"""What a particle and its bonds need while a scene is set up, generously; larger scenes are left out."""
PICTURE = "sizes.png"
COLOURS = {1: "#1f6f8b", 2: "#d1782f"}


@dataclass
class Row:
    """A scene and number of threads: CPU s of set-up and compiling, steps per wall and CPU s, peak memory in MB."""

    particles: int
    bonds: int
    threads: int
    steps: int = 0
    set_up_s: float = 0.0
    per_wall_s: float = 0.0
    per_cpu_s: float = 0.0
    memory_MB: float = 0.0
    problem: str = ""


def grains(side: int) -> Body:
    """Return side³ copies of the paper's grain, 1.01 diameters apart."""
    one = base_grain()
    places = np.stack(np.meshgrid(*3 * [np.arange(side)], indexing="ij"), axis=-1).reshape(-1, 3)
    position = (places[:, None] * SPACING * GRAIN_DIAMETER + one.position).reshape(-1, 3)
    ends = (len(one.position) * np.arange(len(places))[:, None, None] + one.ends).reshape(-1, 2)
    return Body(f"grains{side}", position, ends, one.diameter)


def measure(task: Task) -> list[Row]:
    """Measure every size that fits the effort and the memory of this machine."""
    found = []
    for side in GRAINS_PER_SIDE[task.effort]:
        body = grains(side)
        particles, bonds = len(body.position), len(body.ends)
        if particles * BYTES_PER_PARTICLE > free_memory():
            found.append(Row(particles, bonds, 1, problem="more memory needed than is free"))
            continue
        write_tables(body, task.folder)
        file = write_scene(scene(body), task.folder / f"{body.name}.yaml")
        for threads in THREADS:
            found.append(measure_one(file, particles, bonds, threads))
            say(f"sizes: {particles} particles, {threads} threads: {number(found[-1].per_wall_s)} steps/s")
    return found


def measure_one(file: Path, particles: int, bonds: int, threads: int) -> Row:
    """Measure one size with a number of threads, in a process of its own."""
    steps = max(10, int(STEPS_OF_PARTICLES / particles))
    row = Row(particles, bonds, threads, steps)
    try:
        _, told = worker("window", file, FIRST, FIRST + steps, threads)
    except BenchmarkError as error:
        row.problem = str(error).splitlines()[-1]
        return row
    row.set_up_s, row.memory_MB = told["set_up_s"], told["memory_MB"]
    row.per_wall_s, row.per_cpu_s = steps / told["wall_s"], steps / told["cpu_s"]
    return row


def free_memory() -> float:
    """Return the bytes that are free now; endless where the system does not say."""
    try:
        lines = Path("/proc/meminfo").read_text().splitlines()
    except OSError:
        return float("inf")
    return next((1024.0 * int(line.split()[1]) for line in lines if line.startswith("MemAvailable")), float("inf"))


def text(found: list[Row], pictures: Path) -> str:
    """Return the section."""
    ready = [row for row in found if not row.problem]
    draw(ready, pictures / PICTURE)
    told = (
        "Copies of the grain of 361 primaries between two plates, Model 3 and contacts; the particles are read from a "
        "table. Set-up is all before the first step (reading, checks, tables, neighbours), without compiling. Scenes "
        "of at most 4096 particles run on one thread, whatever is asked for."
    )
    head = ("particles", "bonds", "threads", "steps per s", "ns per bond and step", "set-up, CPU s", "memory, MB")
    rows = [
        [
            number(row.particles),
            number(row.bonds),
            str(row.threads),
            number(row.per_wall_s) if not row.problem else row.problem,
            number(1e9 / (row.per_wall_s * row.bonds)) if not row.problem else "",
            number(row.set_up_s),
            number(row.memory_MB),
        ]
        for row in found
    ]
    speed_up = gain(ready)
    return "\n\n".join(
        [
            "## Size and threads",
            told + speed_up,
            f"![Speed and memory against size]({pictures.name}/{PICTURE})",
            table(head, rows),
        ]
    )


def gain(found: list[Row]) -> str:
    """Say what the second thread brings on the largest scene."""
    one = {row.particles: row.per_wall_s for row in found if row.threads == 1}
    two = {row.particles: row.per_wall_s for row in found if row.threads == 2}
    both = sorted(set(one) & set(two))
    if not both or (os.cpu_count() or 1) < 2:
        return ""
    return (
        f" Two threads make {two[both[-1]] / one[both[-1]]:.2f} times the steps of one on {number(both[-1])} particles."
    )


def draw(found: list[Row], file: Path) -> None:
    """Draw particle steps per second and memory against the number of particles."""
    figure, (speed, memory) = new_figure(2, 4.4, 3.4)
    for threads in sorted({row.threads for row in found}):
        rows = [row for row in found if row.threads == threads]
        x, y = [row.particles for row in rows], [1e-6 * row.per_wall_s * row.bonds for row in rows]
        colour = COLOURS.get(threads, "#777777")
        speed.plot(x, y, "o-", color=colour, label=f"{threads} thread{'' if threads == 1 else 's'}")
        if threads == 1:
            memory.plot(x, [row.memory_MB for row in rows], "o-", color=colour)
    speed.set_ylim(bottom=0.0)
    speed.legend(frameon=False)
    memory.set_yscale("log")
    for axis, label in ((speed, "million bonds stepped per second"), (memory, "peak memory in MB")):
        axis.set_xscale("log")
        axis.set_xlabel("particles")
        axis.set_ylabel(label)
        axis.spines[["top", "right"]].set_visible(False)
    save(figure, file)


SECTION = Section("size", "speed and memory against size, one thread and two", list[Row], measure, text)
