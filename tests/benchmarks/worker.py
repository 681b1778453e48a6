"""What runs in a process of its own: one scene, timed from inside; prints one line of JSON.

``python -m tests.benchmarks.worker FILE FIRST LAST`` builds the scene, steps to FIRST, then times the steps to LAST.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

from clast import Simulation, load


def main(file: Path, first: int, last: int) -> dict[str, float]:
    """Run a scene and return its times in s; ``first_step_at`` is the wall clock when FIRST was reached."""
    begun = time.process_time()
    simulation = Simulation(load(file))
    built = time.process_time()
    simulation.advance_to(first)
    ready, at, wall = time.process_time(), time.time(), time.perf_counter()
    simulation.advance_to(last)
    return {
        "build_s": built - begun,
        "load_s": ready - built,
        "cpu_s": time.process_time() - ready,
        "wall_s": time.perf_counter() - wall,
        "first_step_at": at,
        "broken": simulation.bonds_broken,
        "rebuilds": simulation.rebuilds,
    }


if __name__ == "__main__":
    print(json.dumps(main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))))
