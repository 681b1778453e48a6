"""The page: one table a group from what became of every entry, and nothing else."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from tests.stability.entry import ACCURATE, GARBAGE, REFUSED, STOPPED, Verdict
from tests.stability.matrix import GROUPS

CHANGED = re.compile(r"^change of '[^']*': ")
PICTURE = Path("img") / "stability.png"
OPENING = """\
# Stability under stress

What becomes of scenes at the edge of what can be computed. Every scene is either stable and accurate, with the number
that was asked for beside it, or refused before it starts, or stopped with a sentence that says what to change; a
stopped run keeps its results up to there and its last good checkpoint. A scene that ends as if all were well with a
wrong answer would stand here as **SILENT GARBAGE**.

`python -m tests.stability` runs all of it and writes this page; the test suite runs the part marked ●.

With `time.allow_unstable` a step that the scene outgrows goes on with a warning, as long as the energy held does not
exceed the energy given. In a soft grain whose contacts stiffen it may not: dashpots and friction take up at once what
single vibrations gain. At three times the limit the ledger of such a grain still closes to 0.6 % of the work, and it
holds 70 % of what its plates gave: no energy comes from nowhere that a watch could find. Such a run is inaccurate, not
unstable; the warning says so.
"""


def page(found: Mapping[str, Sequence[Verdict]]) -> str:
    """Return the page as markdown."""
    parts = [OPENING, counts([verdict for each in found.values() for verdict in each])]
    parts.append(f"![What becomes of a scene when its step grows]({PICTURE.as_posix()})\n")
    for group in GROUPS:
        if group.name in found:
            parts.append(f"## {group.title}\n\n{group.text}\n\n{table(found[group.name])}")
    return "\n".join(parts)


def counts(verdicts: Sequence[Verdict]) -> str:
    """Return how many entries ended in which way."""
    kinds = ((ACCURATE, "stable and accurate"), (REFUSED, "refused"), (STOPPED, "stopped"), (GARBAGE, "silent garbage"))
    each = ", ".join(f"{sum(v.kind == kind for v in verdicts)} {name}" for kind, name in kinds)
    return f"**{len(verdicts)} scenes: {each}.**\n"


def table(verdicts: Sequence[Verdict]) -> str:
    """Return one row an entry."""
    rows = ["| | scene | asked | became |", "|---|---|---|---|"]
    for verdict in verdicts:
        asked = verdict.answer.asked if verdict.answer else ""
        mark = "●" if verdict.entry.short else ""
        rows.append(f"| {mark} | {verdict.entry.name} | {asked} | {outcome(verdict)} |")
    return "\n".join(rows) + "\n"


def outcome(verdict: Verdict) -> str:
    """Return what became of an entry in one line."""
    answer = verdict.answer
    if answer is None:
        kept = ", checkpoint kept" if verdict.kind == STOPPED else ""
        return f"{verdict.kind}{kept}: {CHANGED.sub('', ' '.join(verdict.message.split()))}"
    number = f"{answer.error:.1g}, bound {answer.bound:g}"
    return f"stable, accurate ({number})" if verdict.kind == ACCURATE else f"**{GARBAGE}** ({number})"
