"""Examining a case: run it, and tell what it found, why it does not apply, or what stopped it."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

from clast.errors import ClastError
from clast.verification.bench import Bench
from clast.verification.case import Case
from clast.verification.finding import Finding
from clast.verification.sketch import Sketch

PASSED, FAILED, NOT_APPLICABLE = "passed", "failed", "not applicable"


@dataclass
class Outcome:
    """What came out of a case.

    Attributes
    ----------
    case : Case
    findings : list of Finding
    sketches : list of Sketch
    seconds : float
        Wall-clock time, compiling included.
    not_applicable : str
        Why the case says nothing about the parts of its scene; empty where it does.
    stopped : str
        What kept it from its end; empty where nothing did.
    """

    case: Case
    findings: list[Finding] = field(default_factory=list)
    sketches: list[Sketch] = field(default_factory=list)
    seconds: float = 0.0
    not_applicable: str = ""
    stopped: str = ""

    @property
    def verdict(self) -> str:
        """One of passed, failed and not applicable; a case that found nothing has failed."""
        if self.not_applicable:
            return NOT_APPLICABLE
        good = self.findings and not self.stopped and all(each.passed for each in self.findings)
        return PASSED if good else FAILED


def examine(case: Case, bench: Bench) -> Outcome:
    """Run a case on its bench, unless what it needs is missing.

    A run that is refused or blows up stops the case, not the suite.
    """
    outcome = Outcome(case)
    scene, begin = bench.scene(), time.perf_counter()
    reasons = [reason for reason in (need(scene) for need in case.needs) if reason]
    if reasons:
        outcome.not_applicable = reasons[0]
        return outcome
    try:
        for each in case.judge(bench):
            (outcome.sketches if isinstance(each, Sketch) else outcome.findings).append(each)  # type: ignore[arg-type]
    except ClastError as error:
        outcome.stopped = str(error)
    outcome.seconds = time.perf_counter() - begin
    return outcome
