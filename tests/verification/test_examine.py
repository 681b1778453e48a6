"""What comes out of a case, whatever its judge does."""

import pytest

from clast.errors import RunError
from clast.verification.bench import Bench
from clast.verification.case import Case
from clast.verification.examine import examine
from clast.verification.finding import Finding

GOOD, BAD = Finding("good", 1.0, 1.0, 0.1), Finding("bad", 1.0, 1.2, 0.1)


def examined(*told, needs=()):
    """Return the outcome of a case whose judge yields findings and raises errors."""

    def judge(bench):
        for each in told:
            if isinstance(each, Exception):
                raise each
            yield each

    case = Case("case", "title", "chung_ooi_1_head_on", judge, "nothing", needs)
    return examine(case, Bench(case.config))


def test_a_case_passes_when_all_its_findings_do():
    assert examined(GOOD, GOOD).verdict == "passed"
    assert examined(GOOD, BAD).verdict == "failed"


def test_a_case_that_finds_nothing_has_failed():
    assert examined().verdict == "failed"


def test_a_run_that_stops_fails_its_case_with_what_it_said():
    outcome = examined(GOOD, RunError("the run blew up"))
    assert (outcome.verdict, outcome.stopped, len(outcome.findings)) == ("failed", "the run blew up", 1)


def test_a_case_whose_needs_are_not_met_is_not_run():
    outcome = examined(RunError("it ran"), needs=(lambda scene: None, lambda scene: "no friction"))
    assert (outcome.verdict, outcome.not_applicable, outcome.stopped) == ("not applicable", "no friction", "")


def test_a_mistake_in_a_judge_is_not_taken_for_a_failed_case():
    with pytest.raises(ZeroDivisionError):
        examined(ZeroDivisionError())


def test_an_error_as_a_share_of_nothing_is_refused():
    with pytest.raises(ValueError, match="make it absolute"):
        Finding("speed", expected=0.0, got=0.0, bound=1.0)
