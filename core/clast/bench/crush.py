"""Section: whole crushings, the spread of peak stress and strain over seeds, against the time step."""

from __future__ import annotations

import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from itertools import product
from multiprocessing import get_context
from pathlib import Path
from statistics import fmean, stdev
from typing import Any, NamedTuple

from clast.bench.measure import number, say
from clast.bench.places import scene_file
from clast.bench.plot import new_figure, save
from clast.bench.section import Effort, Section, Task
from clast.bench.tables import table
from clast.config.scene import SceneConfig, load
from clast.errors import ClastError
from clast.simulation import Simulation

WORKERS = 2
SAMPLES = 500
FACTORS = (0.16, 0.1, 0.05, 0.025)
SEEDS = 10
RULE = 0.1
FINE_PRIMARY = "0.25 mm"
PICTURE = "error_crush.png"
COLOUR, OTHER = "#1f6f8b", "#d1782f"


class Peak(NamedTuple):
    """One crushing: largest mean stress between samples in Pa, the strain there, and CPU s."""

    stress: float
    strain: float
    cpu_s: float


@dataclass
class Crushings:
    """Crushings of several seeds with one step and one choice of parts."""

    integrator: str
    kinematics: str
    factor: float
    peaks: list[Peak] = field(default_factory=list)
    problem: str = ""

    @property
    def label(self) -> str:
        """Name on the page."""
        return f"{self.integrator}, {self.kinematics}"


@dataclass
class Crushed:
    """All of them, and how many primaries a grain has."""

    primaries: int
    groups: list[Crushings]


def crush(config: SceneConfig) -> Peak:
    """Crush a grain and return its peak."""
    simulation = Simulation(config, 1)
    simulation.advance_to(0)
    walls, gauge = simulation.world.walls, simulation.gauge
    every = max(1, simulation.last_step // SAMPLES)
    best, begun = Peak(0.0, 0.0, 0.0), time.process_time()
    for step in range(every, simulation.last_step + 1, every):
        walls.force_sum[:] = 0.0
        simulation.advance_to(step)
        stress = gauge.forces(simulation.world.walls.force_sum / every)[0] / gauge.area
        if stress > best.stress:
            best = Peak(stress, gauge.strain(simulation.world.walls), 0.0)
    return best._replace(cpu_s=time.process_time() - begun)


def job(files: tuple[Path, ...], changes: dict[str, Any]) -> Peak | str:
    """Crush the grain of the benchmark with some changes; a sentence where that cannot be."""
    try:
        plugins = {"plugins": [str(file.resolve()) for file in files]} if files else {}
        return crush(load(scene_file("crush")).changed(plugins | changes))
    except ClastError as error:
        return str(error).splitlines()[-1]


def plan(task: Task) -> list[Crushings]:
    """Return what is to be crushed: the scene's own parts at every step, the others at the rule's."""
    names = task.registry.names
    own = load(scene_file("crush"))
    assert own.bonds is not None
    mine = (own.integrator.name, own.bonds.kinematics.name)
    groups = [Crushings(*mine, factor) for factor in (FACTORS[:-1] if task.effort is Effort.QUICK else FACTORS)]
    if task.effort is not Effort.QUICK:
        ways = product(names("integrator"), names("bond_kinematics"))
        groups += [Crushings(*way, RULE) for way in ways if way != mine]
    return groups


def measure(task: Task) -> Crushed:
    """Crush grains of several seeds, two at a time; CPU time is each process's own."""
    groups = plan(task)
    seeds = range(1, 1 + (4 if task.effort is Effort.QUICK else SEEDS))
    size = {"particles.primary_diameter": FINE_PRIMARY} if task.effort is Effort.FULL else {}
    with ProcessPoolExecutor(WORKERS, mp_context=get_context("spawn")) as pool:
        waiting = {
            (k, seed): pool.submit(job, task.files, size | changes(group, seed))
            for seed in seeds
            for k, group in enumerate(groups)
        }
        for (k, seed), ended in waiting.items():
            found = ended.result()
            if isinstance(found, str):
                groups[k].problem = found
            else:
                groups[k].peaks.append(found)
            if k == len(groups) - 1:
                say(f"crush: seed {seed} of {len(seeds)}")
    scene = Simulation(load(scene_file("crush")).changed(size), 1).scene
    return Crushed(len(scene.radius), groups)


def changes(group: Crushings, seed: int) -> dict[str, Any]:
    """Return what the scene must be told."""
    return {
        "particles.seed": seed,
        "time.step": {"rule": "paper", "factor": group.factor},
        "integrator": group.integrator,
        "bonds.kinematics": group.kinematics,
    }


def text(found: Crushed, pictures: Path) -> str:
    """Return the section."""
    own = [group for group in found.groups if group.label == found.groups[0].label]
    draw(own, pictures / PICTURE)
    rows = [row(group) for group in found.groups]
    seeds = max(len(group.peaks) for group in found.groups)
    head = ("", "step, share of the paper's limit", "peak stress, MPa", "strain at peak, %", "CPU s a run")
    told = (
        f"{seeds} grains of about {found.primaries} primaries, from {seeds} seeds, are crushed to 25 % strain with "
        "Model 3 (`configs/benchmarks/crush.yaml`; mean and standard deviation, the stress being the mean between two "
        "of 500 samples). Which bond breaks next is decided by the last digit, so single runs differ with the step as "
        "they do with the seed; what can be asked of a step is that the spread stays where it is. "
        f"{drift(own)}"
    )
    return "\n\n".join(
        ["### A whole crushing", told, f"![Peaks against the step]({pictures.name}/{PICTURE})", table(head, rows)]
    )


def row(group: Crushings) -> list[str]:
    """Return a line of the table."""
    name, step = group.label, f"{group.factor:g}"
    if len(group.peaks) < 2:
        return [name, step, group.problem or "not measured", "", ""]
    stress, strain = [1e-6 * p.stress for p in group.peaks], [100.0 * p.strain for p in group.peaks]
    cpu = fmean(p.cpu_s for p in group.peaks)
    return [name, step, f"{spread(stress)}", f"{spread(strain)}", number(cpu)]


def spread(values: list[float]) -> str:
    """Write mean and standard deviation.

    >>> spread([4.0, 5.0, 6.0])
    '5.00 ± 1.00'
    """
    return f"{fmean(values):.2f} ± {stdev(values):.2f}"


def drift(own: list[Crushings]) -> str:
    """Say how far the mean peak moves over the steps, beside its standard error."""
    ready = [group for group in own if len(group.peaks) > 1]
    if len(ready) < 2:
        return ""
    means = [fmean(p.stress for p in group.peaks) for group in ready]
    errors = [stdev(p.stress for p in group.peaks) / len(group.peaks) ** 0.5 for group in ready]
    moved, known = (max(means) - min(means)) / means[-1], max(errors) / means[-1]
    word = "within" if moved <= 2.0 * known else "more than"
    return (
        f"From the coarsest step to the finest the mean peak stress moves by {100.0 * moved:.1f} %, {word} twice the "
        f"standard error of such a mean ({100.0 * known:.1f} %)."
    )


def draw(own: list[Crushings], file: Path) -> None:
    """Draw the peaks of every seed, their mean and standard deviation, against the step."""
    figure, axes = new_figure(2, 4.2, 3.5)
    ready = [group for group in own if len(group.peaks) > 1]
    for axis, name, unit in zip(axes, ("stress", "strain"), (1e-6, 100.0), strict=True):
        for group in ready:
            values = [unit * getattr(peak, name) for peak in group.peaks]
            axis.plot([group.factor] * len(values), values, "o", color=COLOUR, alpha=0.35, markersize=4)
            axis.errorbar(group.factor * 1.06, fmean(values), stdev(values), fmt="s", color=OTHER, capsize=3)
        axis.set_xscale("log")
        axis.set_ylim(bottom=0.0)
        axis.set_xticks([group.factor for group in ready], [f"{group.factor:g}" for group in ready])
        axis.minorticks_off()
        axis.set_xlabel("time step, share of the paper's limit")
        axis.spines[["top", "right"]].set_visible(False)
    axes[0].set_ylabel("peak stress in MPa")
    axes[1].set_ylabel("strain at the peak in %")
    figure.suptitle("Peaks of whole crushings: seeds (dots), mean and standard deviation (squares)", fontsize=10)
    save(figure, file)


SECTION = Section("crush", "peak stress and strain of whole crushings against the step", Crushed, measure, text)
