"""The table of all findings: rows of text, for terminals, pipes and pages."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from math import isfinite
from typing import Any, NamedTuple

from clast.verification.examine import FAILED, NOT_APPLICABLE, PASSED, Outcome
from clast.verification.finding import Finding

HEADINGS = ("case", "quantity", "expected", "got", "error", "bound", "time")


class Row(NamedTuple):
    """One line of the table; ``verdict`` is that of the line."""

    cells: tuple[str, ...]
    verdict: str


def rows(outcome: Outcome) -> Iterator[Row]:
    """Return the lines of one case: the first has its name and time, each one finding; one line where there is none."""
    names = [outcome.case.name] + [""] * len(outcome.findings)
    times = [f"{outcome.seconds:.1f} s"] + [""] * len(outcome.findings)
    for name, finding, time in zip(names, outcome.findings, times, strict=False):
        yield Row((name, *cells(finding), time), PASSED if finding.passed else FAILED)
    if outcome.verdict == NOT_APPLICABLE:
        yield Row((outcome.case.name, f"not applicable: {outcome.not_applicable}", *[""] * 5), NOT_APPLICABLE)
    elif outcome.stopped:
        yield Row((outcome.case.name, f"stopped: {outcome.stopped}", *[""] * 5), FAILED)


def cells(finding: Finding) -> tuple[str, str, str, str, str]:
    """Return quantity, both numbers, the error and its bound; shares are written in per cent."""
    return (
        finding.quantity,
        f"{finding.expected:.6g}",
        f"{finding.got:.6g}",
        size(finding.error, finding.absolute),
        size(finding.bound, finding.absolute),
    )


def size(error: float, absolute: bool) -> str:
    """Return an error as text.

    >>> size(0.00031, absolute=False), size(0.00031, absolute=True)
    ('0.031 %', '3.1e-04')
    """
    if error == 0.0:
        return "0"
    return f"{error:.1e}" if absolute else f"{100.0 * error:.2g} %"


def total(outcomes: Sequence[Outcome]) -> str:
    """Return the line below the table."""
    counts = Counter(outcome.verdict for outcome in outcomes)
    told = ", ".join(f"{counts[verdict]} {verdict}" for verdict in (PASSED, FAILED, NOT_APPLICABLE) if counts[verdict])
    return f"{len(outcomes)} cases: {told}; {sum(outcome.seconds for outcome in outcomes):.1f} s"


def plain(outcome: Outcome) -> dict[str, Any]:
    """Return an outcome as plain data, for JSON; what is not a finite number becomes None."""
    return {
        "case": outcome.case.name,
        "title": outcome.case.title,
        "verdict": outcome.verdict,
        "not_applicable": outcome.not_applicable or None,
        "stopped": outcome.stopped or None,
        "seconds": outcome.seconds,
        "findings": [
            {
                "quantity": each.quantity,
                "expected": float(each.expected),
                "got": finite(each.got),
                "error": finite(each.error),
                "error_is": "absolute" if each.absolute else "relative",
                "bound": float(each.bound),
                "passed": each.passed,
            }
            for each in outcome.findings
        ],
    }


def finite(number: float) -> float | None:
    """Return a number that JSON has."""
    return float(number) if isfinite(number) else None
