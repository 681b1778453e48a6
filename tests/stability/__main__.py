"""``python -m tests.stability``: run the matrix, and write ``docs/stability.md``."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from tests.stability import page, plot
from tests.stability.entry import GARBAGE, Verdict, run_entry
from tests.stability.matrix import GROUPS

ROOT = Path(__file__).resolve().parents[2]


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.stability", description="Stress Clast, tell what happens.")
    names = [group.name for group in GROUPS]
    parser.add_argument("--only", choices=names, action="append", help="run this group only, and write nothing")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "stability.md", help="the page")
    return parser.parse_args(arguments)


def main(arguments: Sequence[str]) -> int:
    """Run what is asked for; fail where an entry does not end as it has to."""
    options = parse(arguments)
    begun = time.perf_counter()
    found: dict[str, list[Verdict]] = {}
    for group in GROUPS:
        if not options.only or group.name in options.only:
            print(group.title, flush=True)
            found[group.name] = [told(run_entry(entry)) for entry in group.entries]
    if not options.only:
        plot.draw(found, options.output.parent / page.PICTURE)
        options.output.write_text(page.page(found))
    verdicts = [verdict for each in found.values() for verdict in each]
    wrong = [verdict for verdict in verdicts if not verdict.as_expected]
    silent = sum(verdict.kind == GARBAGE for verdict in verdicts)
    seconds = time.perf_counter() - begun
    print(f"{len(verdicts)} entries, {len(wrong)} not as they have to be, {silent} silent garbage; {seconds:.0f} s")
    return 1 if wrong else 0


def told(verdict: Verdict) -> Verdict:
    """Print one verdict and return it."""
    mark = " " if verdict.as_expected else "!"
    print(f"{mark} {verdict.entry.name:45} {page.outcome(verdict)}  ({verdict.seconds:.1f} s)", flush=True)
    return verdict


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
