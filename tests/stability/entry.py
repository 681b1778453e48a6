"""Entry: one scene under stress, what is asked of it, and what became of it."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast import Simulation, open_run
from clast.config.scene import SceneConfig
from clast.errors import ClastError, ConfigError, RunError
from clast.results import checkpoint
from clast.session import Listener, run_scene

ACCURATE, REFUSED, STOPPED, GARBAGE = "accurate", "refused", "stopped", "SILENT GARBAGE"


class Ran(NamedTuple):
    """A scene that ran to its end: the simulation as it is then, and what was kept at every sample."""

    simulation: Simulation
    curves: dict[str, NDArray[np.float64]]
    particles: dict[str, NDArray[np.float64]]
    bonds: dict[str, NDArray[np.float64]]


class Answer(NamedTuple):
    """What was asked, how far the scene is from it, and how far it may be; shares, not percent."""

    asked: str
    error: float
    bound: float


@dataclass(frozen=True)
class Entry:
    """One scene under stress.

    Attributes
    ----------
    name : str
        What is varied, with its value.
    scene : () -> SceneConfig
    judge : (ran) -> Answer
        Compares a scene that ran to its end with what is known about it.
    expected : str
        What has to become of it: ACCURATE, REFUSED or STOPPED.
    short : bool
        Whether it is part of the test suite.
    x : float
        Where a picture shows it.
    """

    name: str
    scene: Callable[[], SceneConfig]
    judge: Callable[[Ran], Answer]
    expected: str = ACCURATE
    short: bool = False
    x: float = 0.0


@dataclass(frozen=True)
class Group:
    """Entries that stress the same thing."""

    name: str
    title: str
    text: str
    entries: tuple[Entry, ...]


class Verdict(NamedTuple):
    """What became of an entry: its kind, the answer or the message, and the seconds it took."""

    entry: Entry
    kind: str
    answer: Answer | None
    message: str
    seconds: float

    @property
    def as_expected(self) -> bool:
        """Whether the entry ended as it has to."""
        return self.kind == self.entry.expected


class Kept(Listener):
    """Keeps the simulation that a session runs."""

    simulation: Simulation

    def started(self, simulation: Simulation) -> None:
        """Remember the simulation."""
        self.simulation = simulation


def run_entry(entry: Entry) -> Verdict:
    """Run one entry into a folder that is thrown away, and judge what is left."""
    begun = time.perf_counter()
    with tempfile.TemporaryDirectory() as place, np.errstate(all="ignore"):
        folder, kept = Path(place) / "run", Kept()
        answer, message = None, ""
        try:
            config = entry.scene()
            run_scene(config, folder, listener=kept)
            answer = entry.judge(read(kept.simulation, folder))
            kind = ACCURATE if answer.error <= answer.bound else GARBAGE
        except RunError as error:
            kind, message = STOPPED, f"{error}{'' if left_whole(config, folder) else ' [NOTHING KEPT]'}"
        except ClastError as error:
            kind, message = REFUSED, str(error)
    return Verdict(entry, kind, answer, message, time.perf_counter() - begun)


def read(simulation: Simulation, folder: Path) -> Ran:
    """Return what a run kept."""
    with open_run(folder) as run:
        curves = {name: np.asarray(values) for name, values in run.curves.items()}
        tracks = {
            what: {name: np.asarray(values) for name, values in run.tracks.get(what, {}).items()}
            for what in ("particles", "bonds")
        }
    return Ran(simulation, curves, tracks["particles"], tracks["bonds"])


def left_whole(config: SceneConfig, folder: Path) -> bool:
    """Tell whether a stopped run left results that open and a checkpoint with nothing but numbers in it."""
    try:
        with open_run(folder) as run:
            sound = all(np.isfinite(values).all() for values in run.curves.values())
        simulation = Simulation(config)
        checkpoint.load(folder, simulation)
    except (ConfigError, RunError):
        return False
    tables: list[Any] = [simulation.world.particles.pose, simulation.world.particles.twist]
    return sound and all(bool(np.isfinite(table).all()) for table in tables)
