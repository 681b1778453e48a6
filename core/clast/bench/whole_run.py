"""One run as a user makes it, timed part by part from inside; prints one line of JSON at the end.

``python -m clast.bench.whole_run FILE FOLDER [KEY=VALUE ...]``
"""

from __future__ import annotations

import json
import sys
import time
from collections import defaultdict
from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from clast import Simulation, load
from clast.results import checkpoint
from clast.results.frames import Frames
from clast.results.memory import peak_memory
from clast.results.samples import Samples
from clast.results.store import Store
from clast.scene.neighbour_lists import NeighbourLists
from clast.session import Listener, _Session, run_scene
from clast.stability.step_keeper import StepKeeper

PARTS = 10
OUTPUT = ("samples", "frames", "saving")
ENDING = "curves, summary"


class Clocks(Listener):
    """CPU s that this process spends in each kind of work since the first step, and the speed along the way."""

    def __init__(self) -> None:
        self.spent: defaultdict[str, float] = defaultdict(float)
        self.told: dict[str, Any] = {"memory_MB": {"scene read": peak_memory()}}
        self.marks: list[tuple[int, float, float, int]] = []
        self.begun = 0.0
        self.busy = False

    def started(self, simulation: Simulation) -> None:
        """Start the clocks: everything is compiled now."""
        self.told |= {"first_step_at": time.time(), "particles": len(simulation.scene.radius)}
        self.told |= {"bonds": len(simulation.scene.ends), "steps": simulation.last_step}
        self.told["memory_MB"]["first step"] = peak_memory()
        self.spent.clear()
        self.begun = time.process_time()
        self.mark(simulation)

    def mark(self, simulation: Simulation) -> None:
        """Note how far the run is."""
        strain = simulation.gauge.strain(simulation.world.walls)
        stepping = time.process_time() - self.begun - sum(self.spent[name] for name in OUTPUT)
        self.marks.append((simulation.step, strain, stepping, simulation.lists.made))

    def stop(self) -> None:
        """Stop the clocks: the last step is taken."""
        self.told |= {"loop_s": time.process_time() - self.begun, "last_step_at": time.time()}
        self.told["memory_MB"]["last step"] = peak_memory()

    def timed(self, name: str, work: Callable[..., Any]) -> Callable[..., Any]:
        """Return a function that does the same and is clocked, unless a clocked one called it."""

        def clocked(*arguments: Any, **named: Any) -> Any:
            if self.busy:
                return work(*arguments, **named)
            self.busy, begun = True, time.process_time()
            try:
                return work(*arguments, **named)
            finally:
                self.busy = False
                self.spent[name] += time.process_time() - begun

        return clocked

    def watch(self) -> None:
        """Clock the lists of neighbours, the looks at the stable step, and what a session does besides stepping."""
        lists = self.timed("lists", NeighbourLists.brought_up_to_date)
        NeighbourLists.brought_up_to_date = lists  # type: ignore[method-assign]
        StepKeeper.look = self.timed("limit", StepKeeper.look)  # type: ignore[method-assign]
        Samples.observe = self.timed("samples", Samples.observe)  # type: ignore[method-assign]
        Store.flush = self.timed("saving", Store.flush)  # type: ignore[method-assign]
        checkpoint.save = self.timed("saving", checkpoint.save)
        look, finish = self.timed("frames", Frames.observe), self.timed(ENDING, _Session.finish)

        def look_and_mark(*arguments: Any) -> None:
            look(*arguments)
            if self.begun:
                self.mark(arguments[-1])

        def stop_and_finish(*arguments: Any) -> Any:
            self.stop()
            return finish(*arguments)

        Frames.observe = look_and_mark  # type: ignore[method-assign, assignment]
        _Session.finish = stop_and_finish  # type: ignore[method-assign, assignment]


def speed(marks: Sequence[tuple[int, float, float, int]]) -> list[dict[str, float]]:
    """Return strain, steps per CPU s without output, and lists made, for equal parts of a run."""
    count = len(marks) - 1
    parts = min(PARTS, count)
    rows = [marks[round(k * count / parts)] for k in range(parts + 1)] if parts else []
    return [
        {
            "strain": last[1],
            "steps_per_s": (last[0] - first[0]) / max(last[2] - first[2], 1e-9),
            "lists": last[3] - first[3],
        }
        for first, last in pairwise(rows)
    ]


def main(file: Path, folder: Path, settings: Sequence[str]) -> dict[str, Any]:
    """Run a scene and tell where the time went."""
    config = load(file, settings)
    clocks = Clocks()
    clocks.watch()
    run_scene(config, folder, listener=clocks, threads=1)
    clocks.told["memory_MB"]["end"] = peak_memory()
    return clocks.told | {"spent_s": dict(clocks.spent), "speed": speed(clocks.marks)}


if __name__ == "__main__":
    print(json.dumps(main(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:])))
