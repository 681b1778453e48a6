"""The short part of the matrix: every entry ends as it has to, and nothing is silent garbage."""

from __future__ import annotations

import pytest

from tests.stability.entry import Entry, run_entry
from tests.stability.matrix import GROUPS
from tests.stability.page import outcome

SHORT = [
    pytest.param(entry, id=f"{group.name}: {entry.name}") for group in GROUPS for entry in group.entries if entry.short
]


@pytest.mark.parametrize("entry", SHORT)
def test_a_scene_under_stress_ends_as_it_has_to(entry: Entry) -> None:
    verdict = run_entry(entry)
    assert verdict.as_expected, outcome(verdict)
    assert "NOTHING KEPT" not in verdict.message
