"""``python -m tests.benchmarks``: measure, and write ``docs/benchmarks.md``."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from tests.benchmarks import features, machine, peer, plot, report, startup
from tests.benchmarks.measure import ROOT, BenchmarkError, say
from tests.benchmarks.report import Measured
from tests.benchmarks.scenes import Body, base_grain, grain_array, write_tables
from tests.benchmarks.throughput import MODELS, Window, compare

SECTIONS = ("grain", "array", "features", "start")
WINDOWS = {"grain": Window(200, 4200, 5), "array": Window(10, 110, 3)}
QUICK_WINDOWS = {"grain": Window(200, 2200, 2), "array": Window(10, 40, 1)}
ROUNDS = {"grain": Window(200, 2200, 5), "array": Window(10, 40, 3)}
QUICK_ROUNDS = {"grain": Window(200, 1200, 3), "array": Window(10, 30, 1)}


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks", description="Measure Clast beside LAMMPS.")
    parser.add_argument(
        "--quick", action="store_true", help="few repeats of short windows: rough numbers in two minutes"
    )
    parser.add_argument("--only", choices=SECTIONS, action="append", help="measure this section only; may be repeated")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "benchmarks.md", help="the report")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str]) -> int:
    """Measure what is asked for and write the report."""
    options = parse(arguments)
    begun = time.perf_counter()
    command = " ".join(["python -m tests.benchmarks", *arguments])
    found = Measured(command, machine.describe(), options.quick)
    os.environ["CLAST_CACHE"] = str(peer.cache_folder().parent / "loops")
    try:
        with tempfile.TemporaryDirectory(prefix="clast-benchmark-") as folder:
            measure(found, options.only or SECTIONS, Path(folder))
    except BenchmarkError as error:
        print(error, file=sys.stderr)
        return 1
    options.output.parent.mkdir(parents=True, exist_ok=True)
    if found.draws:
        plot.draw(found.comparisons, found.run, options.output.parent / report.PICTURE)
    options.output.write_text(report.page(found))
    say(f"wrote {options.output} after {time.perf_counter() - begun:.0f} s")
    return 0


def measure(found: Measured, sections: Sequence[str], folder: Path) -> None:
    """Measure some sections; ``features`` needs the grain, so it brings it along."""
    if "grain" in sections or "features" in sections:
        measure_body(found, base_grain(), folder, every_feature="features" in sections)
    if "array" in sections:
        measure_body(found, grain_array(), folder, every_feature=False)
    if "start" in sections:
        found.waits = startup.measure_waits(2 if found.quick else 5)
        found.run = startup.measure_first_run(found.quick)


def measure_body(found: Measured, body: Body, folder: Path, every_feature: bool) -> None:
    """Compare both codes on a body, and find out where Clast's time goes."""
    write_tables(body, folder)
    names = None if every_feature and not found.quick else features.BREAKDOWN
    files = features.write_variants(body, folder, names)
    say(f"{body.name}: compiling {len(files)} loops where they are not on disk yet")
    features.compile_all(list(files.values()))
    models = list(MODELS) if body.name == "grain" and names is None else list(MODELS)[:1]
    windows = QUICK_WINDOWS if found.quick else WINDOWS
    beside, problem = peer.install()
    found.comparisons.append(compare(body, models, windows[body.name], beside, problem, folder))
    rounds = (QUICK_ROUNDS if found.quick else ROUNDS)[body.name]
    found.costs[body.name] = features.measure_costs(files, rounds.first, rounds.steps, rounds.repeats)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
