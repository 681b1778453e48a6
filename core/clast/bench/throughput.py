"""Steps per CPU second of Clast and its peer, by turns, on the same body, plates, step and materials."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from clast.bench.measure import BenchmarkError, Spread, run_child, say, spread, worker
from clast.bench.peer import Peer, write_input
from clast.bench.scenes import Body, Size, scene, write_scene

MODELS = {"micro_cracking": "Model 3", "elastic_plastic": "Model 2", "elastic": "Model 1"}
PEER = "LAMMPS"


class Window(NamedTuple):
    """Which steps are timed, and how often."""

    first: int
    last: int
    repeats: int

    @property
    def steps(self) -> int:
        """Number of timed steps."""
        return self.last - self.first


@dataclass
class Readings:
    """What was measured of one code or model, one value a repeat.

    Attributes
    ----------
    rate : list of float
        Steps per CPU second.
    memory, set_up, force : list of float
        Peak memory in MB, CPU s before the first step, force on the moving plate in N at the last step.
    """

    rate: list[float] = field(default_factory=list)
    memory: list[float] = field(default_factory=list)
    set_up: list[float] = field(default_factory=list)
    force: list[float] = field(default_factory=list)


@dataclass(frozen=True)
class Comparison:
    """Clast's models and the peer on one body; ``problem`` says why the peer is missing."""

    body: Size
    window: Window
    clast: dict[str, Readings]
    peer: Readings | None
    problem: str

    def rate(self, model: str) -> Spread:
        """Return Clast's steps per CPU second."""
        return spread(self.clast[model].rate)

    def ratio(self, model: str) -> Spread | None:
        """Return Clast's rate over the peer's: of the medians, then the extremes of the single turns."""
        if self.peer is None:
            return None
        turns = [a / b for a, b in zip(self.clast[model].rate, self.peer.rate, strict=True)]
        middle = self.rate(model).median / spread(self.peer.rate).median
        return Spread(middle, min(*turns, middle), max(*turns, middle))

    def nanoseconds_per_bond(self, model: str) -> float:
        """Return what a step costs per bond, all in."""
        return 1e9 / (self.rate(model).median * self.body.bonds)


def compare(
    body: Body, models: Sequence[str], window: Window, peer: Peer | None, problem: str, folder: Path
) -> Comparison:
    """Measure the peer and Clast's models by turns; loops are compiled beforehand."""
    files = {model: write_scene(scene(body, model), folder / f"{body.name}_{model}.yaml") for model in models}
    clast = {model: Readings() for model in models}
    beside = None if peer is None else Readings()
    for turn in range(window.repeats):
        if peer is not None and beside is not None:
            try:
                _time_peer(peer, body, window, beside, folder)
            except BenchmarkError as error:
                peer, beside, problem = (
                    None,
                    None,
                    f"LAMMPS does not run this scene: {str(error).splitlines()[0]}",
                )
        for model, file in files.items():
            _time_clast(file, window, clast[model])
        say(f"{body.name}, turn {turn + 1}: {_turn_text(clast, beside)}")
    return Comparison(body.size, window, clast, beside, problem)


def _time_peer(peer: Peer, body: Body, window: Window, readings: Readings, folder: Path) -> None:
    """Add what the longer of two runs costs more than the shorter."""
    file = write_input(body, folder)
    short = run_child(peer.command(file, window.first), folder, peer.environment())
    long = run_child(peer.command(file, window.last), folder, peer.environment())
    per_step = (long.cpu - short.cpu) / window.steps
    readings.rate.append(1.0 / per_step)
    readings.memory.append(long.memory)
    readings.set_up.append(max(0.0, short.cpu - window.first * per_step))
    readings.force.append(float((folder / f"{body.name}.force").read_text()))


def _time_clast(file: Path, window: Window, readings: Readings) -> None:
    child, told = worker("window", file, window.first, window.last)
    readings.rate.append(window.steps / told["cpu_s"])
    readings.memory.append(child.memory)
    readings.set_up.append(child.cpu - told["cpu_s"])
    readings.force.append(told["force_N"])


def _turn_text(clast: dict[str, Readings], peer: Readings | None) -> str:
    rates = [f"{MODELS[model]} {readings.rate[-1]:,.1f}" for model, readings in clast.items()]
    return ", ".join([*rates, *([] if peer is None else [f"{PEER} {peer.rate[-1]:,.1f}"])]) + " steps per CPU s"
