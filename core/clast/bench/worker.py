"""What runs in a process of its own and is timed from inside; every task prints one line of JSON at the end."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from clast import Simulation, load
from clast.results.memory import peak_memory
from clast.writing import process as writing_process

Measured = dict[str, Any]
ONE_THREAD = 1


def window(file: str, first: str, last: str, threads: str = "1") -> Measured:
    """Time the steps from FIRST to LAST of a scene, in CPU and wall s; the force is that on its first wall."""
    begun = time.process_time()
    simulation = Simulation(load(file), int(threads))
    built = time.process_time()
    simulation.advance_to(int(first))
    ready, watch = time.process_time(), time.perf_counter()
    simulation.advance_to(int(last))
    return {
        "set_up_s": built - begun,
        "wall_s": time.perf_counter() - watch,
        "cpu_s": time.process_time() - ready,
        "memory_MB": peak_memory(),
        "force_N": float(np.linalg.norm(simulation.world.walls.force[0])),
    }


def first_step(file: str) -> Measured:
    """Take one step of a scene; tell the wall clock then."""
    simulation = Simulation(load(file), ONE_THREAD)
    simulation.advance_to(0)
    begun = time.perf_counter()
    simulation.advance_to(1)
    return {"at": time.time(), "step_s": time.perf_counter() - begun}


def compile_scenes(*files: str) -> Measured:
    """Compile the loops of scenes, or find them on disk."""
    for file in files:
        Simulation(load(file), ONE_THREAD).advance_to(0)
    return {}


def compare_scenes(first: str, steps: str, rounds: str, *files: str) -> Measured:
    """Advance several scenes by turns; CPU s per step of each, one value a round."""
    simulations = {Path(file).stem: Simulation(load(file), ONE_THREAD) for file in files}
    for simulation in simulations.values():
        simulation.advance_to(int(first))
    times: dict[str, list[float]] = {name: [] for name in simulations}
    for _ in range(int(rounds)):
        for name, simulation in simulations.items():
            begun = time.process_time()
            simulation.advance_to(simulation.step + int(steps))
            times[name].append((time.process_time() - begun) / int(steps))
    return times


def compare_threads(file: str, first: str, steps: str, rounds: str, *threads: str) -> Measured:
    """Advance copies of a scene on several numbers of threads by turns; wall s per step of each, one value a round."""
    config = load(file)
    simulations = {each: Simulation(config, int(each)) for each in threads}
    for simulation in simulations.values():
        simulation.advance_to(int(first))
    seconds: dict[str, list[float]] = {each: [] for each in threads}
    for _ in range(int(rounds)):
        for each, simulation in simulations.items():
            begun = time.perf_counter()
            simulation.advance_to(simulation.step + int(steps))
            seconds[each].append((time.perf_counter() - begun) / int(steps))
    scene = simulations[threads[0]].scene
    return {"seconds": seconds, "particles": len(scene.radius), "bonds": len(scene.ends)}


def write(folder: str, *names: str) -> Measured:
    """Let writers write the files of a run again, in this process, as the one that a run starts does; peak in MB."""
    with TemporaryDirectory() as drafts:
        writing_process.main(Path(folder), Path(drafts), names)
    return {"memory_MB": peak_memory()}


TASKS = {task.__name__: task for task in (window, first_step, compile_scenes, compare_scenes, compare_threads, write)}


def main(arguments: Sequence[str]) -> None:
    """Run the task named first with the other arguments."""
    print(json.dumps(TASKS[arguments[0]](*arguments[1:])))


if __name__ == "__main__":
    main(sys.argv[1:])
