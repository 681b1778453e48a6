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
from tests.benchmarks.tables import MAIN_MODEL
from tests.benchmarks.throughput import MODELS, Window, compare

SECTIONS = ("grain", "array", "features", "start")
WINDOWS = {"grain": Window(200, 4200, 5), "array": Window(10, 110, 3)}
QUICK_WINDOWS = {"grain": Window(200, 4200, 2), "array": Window(10, 40, 1)}
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
    stepping = [name for name in SECTIONS[:3] if name in sections]
    if stepping:
        every = "features" in sections and not found.quick
        grain = base_grain()
        files = compiled_variants(grain, folder, every)
        beside = peer.install()
        if stepping != ["array"]:
            measure_body(found, grain, files, list(MODELS) if every else [MAIN_MODEL], beside, folder)
        if "array" in sections:
            array = grain_array()
            write_tables(array, folder)
            parts = {} if found.quick else features.write_variants(array, folder, features.BREAKDOWN)
            measure_body(found, array, parts, [MAIN_MODEL], beside, folder)
    if "start" in sections:
        found.run, found.waits = startup.measure_start(2 if found.quick else 3, found.quick)


def compiled_variants(grain: Body, folder: Path, every: bool) -> dict[str, Path]:
    """Write the grain's variants and compile their loops, which all bodies share."""
    write_tables(grain, folder)
    files = features.write_variants(grain, folder, None if every else features.BREAKDOWN)
    say(f"compiling {len(files)} loops where they are not on disk yet")
    features.compile_all(list(files.values()))
    return files


def measure_body(
    found: Measured,
    body: Body,
    files: dict[str, Path],
    models: Sequence[str],
    beside: tuple[peer.Peer | None, str],
    folder: Path,
) -> None:
    """Compare both codes on a body, and find out where Clast's time goes."""
    windows, rounds = (QUICK_WINDOWS, QUICK_ROUNDS) if found.quick else (WINDOWS, ROUNDS)
    found.comparisons.append(compare(body, models, windows[body.name], *beside, folder))
    if files:
        first, last, turns = rounds[body.name]
        found.costs[body.name] = features.measure_costs(files, first, last - first, turns)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
