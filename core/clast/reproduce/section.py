"""What a page tells of one study: its figure, its points, and what becomes of its statements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from clast.studies.outcome import StudyOutcome
from clast.studies.verdict import NOT_REPRODUCED, OPEN, REPRODUCED, Verdict
from clast.studies.work import DONE, FAILED

MARKS = {REPRODUCED: "**reproduced**", NOT_REPRODUCED: "not reproduced", OPEN: "not decidable"}


def section(outcome: StudyOutcome, image: str | None) -> str:
    """Return the Markdown of one study; ``image`` is its figure as seen from the page."""
    parts = [f"![{outcome.folder.name}]({image})"] if image is not None else []
    heads, rows = outcome.point_table()
    parts.append(table(heads, rows))
    lost = [row for row in outcome.table.rows if row.state != DONE]
    if lost:
        counts = {row.state: sum(each.state == row.state for each in lost) for row in lost}
        told = ", ".join(f"{count} {state}" for state, count in counts.items())
        parts.append(f"Of {len(outcome.table.rows)} runs: {told}. {reasons(outcome)}".rstrip())
    if outcome.open_peaks():
        parts.append(f"{outcome.open_peaks()}.")
    if outcome.verdicts:
        rows = [
            [each.expectation.says, each.variant or "–", MARKS[each.verdict], each.evidence]
            for each in outcome.verdicts
        ]
        parts.append(table(["statement", "setting", "verdict", "numbers (SI)"], rows))
    return "\n\n".join(parts)


def reasons(outcome: StudyOutcome) -> str:
    """Return why runs failed, each reason once with the values of its first run."""
    found: dict[str, str] = {}
    for row in outcome.table.rows:
        if row.reason:
            values = ", ".join(f"{each.axis} {each.label}" for each in row.task.settings)
            found.setdefault(row.cause, values)
    return " ".join(f"{values}: {reason}." for reason, values in list(found.items())[:3])


def statements(outcomes: Mapping[str, StudyOutcome]) -> str:
    """Return one table of all statements: a line each, a column for every setting.

    Parameters
    ----------
    outcomes : mapping
        Name of a study -> its outcome.
    """
    every = {name: [(each, _mark(outcome, each)) for each in outcome.verdicts] for name, outcome in outcomes.items()}
    settings = list(dict.fromkeys(verdict.variant for found in every.values() for verdict, _ in found))
    rows = []
    for study, found in every.items():
        for says in dict.fromkeys(verdict.expectation.says for verdict, _ in found):
            given = {verdict.variant: mark for verdict, mark in found if verdict.expectation.says == says}
            rows.append([study, says, *(given.get(setting, "") for setting in settings)])
    return table(["study", "statement", *(setting or "verdict" for setting in settings)], rows)


def _mark(outcome: StudyOutcome, verdict: Verdict) -> str:
    if outcome.table.done(verdict.variant):
        return MARKS[verdict.verdict]
    states = {row.state for row in outcome.table.rows if row.task.variant == verdict.variant}
    return "all runs failed" if states == {FAILED} else "not run"


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a Markdown table."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)
