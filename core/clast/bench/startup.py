"""How long a user waits, and what a run costs besides its steps."""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from clast.bench.measure import Child, Spread, clast, run_child, say, spread, worker
from clast.bench.places import scene_file

SHORT = ("time.end.strain=0.03", "output.frames=12", "output.samples=60")
"""The beginning of the ready scene, with as many samples and frames per step as the whole."""
WRITERS = ("recording", "vtk", "figure", "picture")
ALL = "all four in one process, as a run has them"
OUTPUT = {"samples": "samples", "frames": "frames, each flushed to disk", "saving": "checkpoints"}


READY = "crush_grain"


class Wait(NamedTuple):
    """One thing to wait for: the command, wall and CPU time in s, and what the wall time should stay below."""

    what: str
    command: str
    wall: Spread
    cpu: Spread
    target: float


class Writing(NamedTuple):
    """Writers at work in a process of their own: wall and CPU time in s, its start included, and peak memory in MB."""

    wall: float
    cpu: float
    memory: float


@dataclass(frozen=True)
class FirstRun:
    """The ready scene run where nothing was ever compiled: the process, what it told of itself, and its writers.

    ``writing`` is by writer, and under ``ALL`` for all of them in one process, as the run has it.
    """

    child: Child
    told: dict[str, Any]
    writing: dict[str, Writing]
    short: bool

    @property
    def first_step(self) -> float:
        """Wall s from launch to the first step."""
        return float(self.told["first_step_at"] - self.child.launched_at)

    @property
    def steps_done(self) -> float:
        """Wall s from launch to the last step."""
        return float(self.told["last_step_at"] - self.child.launched_at)

    @property
    def stepping(self) -> float:
        """CPU s of the steps alone, neighbour lists included."""
        return float(self.told["loop_s"]) - self.output

    @property
    def output(self) -> float:
        """CPU s of samples, frames and saving during the run."""
        return float(sum(self.told["spent_s"].get(name, 0.0) for name in OUTPUT))

    @property
    def lists(self) -> float:
        """CPU s of making neighbour lists."""
        return float(self.told["spent_s"].get("lists", 0.0))


def measure_start(repeats: int, short: bool) -> tuple[FirstRun, list[Wait]]:
    """Run the ready scene with empty caches, then measure what is waited for once these are filled."""
    with tempfile.TemporaryDirectory() as empty:
        folder = Path(empty)
        caches = {"CLAST_CACHE": str(folder / "loops"), "NUMBA_CACHE_DIR": str(folder / "numba")}
        return _first_run(folder, caches, short), _waits(repeats, caches)


def _first_run(folder: Path, caches: dict[str, str], short: bool) -> FirstRun:
    """Do what ``make run`` does on a new machine; to 3 % strain when short."""
    say("first run of configs/crush_grain.yaml, with empty caches")
    command = [sys.executable, "-m", "clast.bench.whole_run", str(scene_file(READY)), str(folder / "run")]
    child = run_child([*command, *(SHORT if short else ())], None, caches)
    told = json.loads(child.output.strip().splitlines()[-1])
    return FirstRun(child, told, _writing(folder / "run"), short)


def _writing(run: Path) -> dict[str, Writing]:
    """Let the run's writers write once more, all in one process and each in its own."""
    say("its writers once more")
    found = {}
    for title, names in {ALL: WRITERS, **{name: (name,) for name in WRITERS}}.items():
        child, told = worker("write", run, *names)
        found[title] = Writing(child.wall, child.cpu, told["memory_MB"])
    return found


def _waits(repeats: int, caches: dict[str, str]) -> list[Wait]:
    say("start-up")
    asked = [clast("--help", environment=caches) for _ in range(repeats)]
    checked = [clast("check", scene_file(READY), environment=caches) for _ in range(repeats)]
    started = [worker("first_step", scene_file(READY), environment=caches) for _ in range(repeats)]
    seconds = [told["at"] - child.launched_at for child, told in started]
    return [
        _wait("help", "clast --help", asked, 0.3),
        _wait("check of a scene", "clast check configs/crush_grain.yaml", checked, 1.5),
        Wait(
            "second start to the first step, packing included",
            "load, Simulation, advance_to(1)",
            spread(seconds),
            spread([child.cpu for child, _ in started]),
            2.0,
        ),
    ]


def _wait(what: str, command: str, children: Sequence[Child], target: float) -> Wait:
    return Wait(what, command, spread([c.wall for c in children]), spread([c.cpu for c in children]), target)
