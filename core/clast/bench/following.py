"""Section: what it costs that the time step follows the true limit."""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path

from clast.bench.measure import number, run_child, say
from clast.bench.places import scene_file
from clast.bench.section import Section, Task

SCENE = "crush_grain"
SETTINGS = ("time.step.rule=spectral", "time.step.factor=0.8", "output.ledger=false", "output.writers=[]")
"""The default rule, and steps as cheap as the scene allows, so that the share is at its largest."""
TARGET = 1.0


@dataclass
class Following:
    """One whole run: its steps, how often the limit was estimated anew, CPU s of all looks and of the run."""

    steps: int
    estimates: int
    looks_s: float
    run_s: float

    @property
    def share(self) -> float:
        """What the looks take of the run, in per cent."""
        return 100.0 * self.looks_s / self.run_s


def measure(task: Task) -> Following:
    """Crush the ready grain from start to end; clocks start at the first step, when all is compiled."""
    say("a whole run with the rule spectral")
    folder = task.folder / "following"
    program = [sys.executable, "-m", "clast.bench.whole_run"]
    child = run_child([*program, str(scene_file(SCENE)), str(folder), *SETTINGS])
    told = json.loads(child.output.strip().splitlines()[-1])
    summary = json.loads((folder / "summary.json").read_text())
    looks_s = told["spent_s"].get("limit", 0.0)
    return Following(summary["steps"], summary["time_step_estimates"], looks_s, told["loop_s"])


def text(found: Following, pictures: Path) -> str:
    """Return the section."""
    met = "met" if found.share < TARGET else "**missed**"
    told = (
        f"The rule `spectral` looks at the contacts as they stiffen, and estimates the stable step anew where a bound "
        f"no longer tells that it is safe: {found.estimates} times in the {number(found.steps)} steps of "
        f"`configs/crush_grain.yaml`, run to its end with that rule and without the energy ledger. All looks together "
        f"take {number(found.looks_s)} of {number(found.run_s)} CPU s, {found.share:.2f} % of the run "
        f"(target < {TARGET:g} %: {met})."
    )
    return f"### What following the stable step costs\n\n{told}"


SECTION = Section("following", "the share of a run that following the stable step takes", Following, measure, text)
