"""A sweep: every installed way to compute a problem, at every step; error and CPU time of each."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

import numpy as np

from clast.bench.measure import say
from clast.bench.precision.problem import Problem, Way
from clast.bench.precision.theory import fitted_order, oscillator_order
from clast.bench.section import Effort, Task
from clast.config.scene import SceneConfig
from clast.engine.state import Floats
from clast.errors import ClastError, one_line
from clast.simulation import Simulation

REPEATS = {Effort.QUICK: 1, Effort.USUAL: 3, Effort.FULL: 5}


class Point(NamedTuple):
    """One run: number of steps, relative error, and CPU s of all copies together."""

    steps: int
    error: float
    cpu_s: float


@dataclass
class Series:
    """Runs of one way at several steps.

    Attributes
    ----------
    program : str
        ``Clast`` or the peer.
    way : dict
        Kind of part -> name.
    points : list of Point
    floor : float
        How well the reference is known: its difference from one with half the steps.
    order, expected : float or None
        Fitted and theoretical order of the error.
    problem : str
        Why some steps are missing.
    """

    program: str
    way: Way
    points: list[Point] = field(default_factory=list)
    floor: float = 0.0
    order: float | None = None
    expected: float | None = None
    problem: str = ""

    @property
    def label(self) -> str:
        """Name on the page."""
        return ", ".join(self.way.values()) if self.program == "Clast" else self.program

    def fit(self) -> None:
        """Fit the order."""
        self.order = fitted_order([p.steps for p in self.points], [p.error for p in self.points], self.floor)


@dataclass
class Swept:
    """All series of a problem; ``own`` is the scene's own choice, ``no_peer`` says why the peer is missing."""

    own: Way
    copies: int
    end_s: float
    fine: int
    series: list[Series]
    no_peer: str = ""


def relative(values: Floats, reference: Floats) -> float:
    """Return the root mean square of a difference over that of the reference."""
    return float(np.sqrt(np.mean((values - reference) ** 2) / np.mean(reference**2)))


def sweep(problem: Problem, task: Task) -> list[Series]:
    """Try every way that is installed, each against the finest steps of the scene's own integrator."""
    steps = problem.steps[:-2] if task.effort is Effort.QUICK else problem.steps
    ways = problem.ways(task.registry.names)
    references: dict[str, tuple[Floats, float]] = {}
    found = []
    for way in ways:
        series = Series("Clast", way)
        try:
            series.expected = expected(problem, task, way)
            physics = {kind: name for kind, name in way.items() if kind != "integrator"}
            key = str(physics)
            if key not in references:
                references[key] = reference(problem, task, physics)
            fine, series.floor = references[key]
            for n in steps:
                series.points.append(run(problem, task, way, n, fine))
        except ClastError as error:
            series.problem = one_line(error)
        series.fit()
        say(f"{problem.name}: {series.label}: {told(series)}")
        found.append(series)
    return found


def told(series: Series) -> str:
    """Say in a line what came out."""
    if not series.points:
        return series.problem
    last, order = series.points[-1], "" if series.order is None else f", order {series.order:.2f}"
    return f"error {last.error:.1e} with {last.steps} steps in {last.cpu_s:.2f} CPU s{order}"


def expected(problem: Problem, task: Task, way: Way) -> float:
    """Return the order theory gives: the scheme's own on an oscillator, or what the forces' kinks leave of it."""
    stages = problem.scene(1, task.files).changed(problem.changes(way, problem.steps[-1])).integrator.part.stages
    return min(oscillator_order(stages, problem.damping_ratio), problem.kinks)


def reference(problem: Problem, task: Task, physics: Way) -> tuple[Floats, float]:
    """Return what the finest run sees, and its difference from a run with half the steps."""
    fine, half = (observed(problem, task, physics, n) for n in (problem.fine, problem.fine // 2))
    return fine, relative(half, fine)


def observed(problem: Problem, task: Task, way: Way, steps: int) -> Floats:
    """Return what a run sees."""
    simulation = Simulation(problem.scene(1, task.files).changed(problem.changes(way, steps)), 1)
    return problem.observe(simulation, steps, problem.instants)


def run(problem: Problem, task: Task, way: Way, steps: int, fine: Floats) -> Point:
    """Return error and CPU time of a run, the least of some repeats."""
    error = relative(observed(problem, task, way, steps), fine)
    scene = problem.scene(problem.copies, task.files).changed(problem.changes(way, steps))
    return Point(steps, error, min(map(partial(_clocked, scene), [steps] * REPEATS[task.effort])))


def _clocked(scene: SceneConfig, steps: int) -> float:
    simulation = Simulation(scene, 1)
    simulation.advance_to(0)
    begun = time.process_time()
    simulation.advance_to(steps)
    return time.process_time() - begun
