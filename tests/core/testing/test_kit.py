"""The contract kit: starting files keep to it, and each way to spoil a part breaks the claim that it is about."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from clast.commands.check_parts import check
from clast.config.examples import example
from clast.plugins.discovery import discover, parts_of
from clast.plugins.new import starter_text
from clast.plugins.registry import KINDS
from clast.testing import assert_contract, claims_of
from clast.testing.claim import try_claims
from clast.testing.kit import remarks_on
from tests.core.testing.spoiled_parts import SPOILED


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_a_starting_file_that_keeps_to_its_contract(kind: str, tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(starter_text(kind, "my_part"))
    (entry,) = parts_of(tmp_path / "mine.py")
    assert (entry.kind, entry.name) == (kind, "my_part")
    assert_contract(tmp_path / "mine.py")


@pytest.mark.parametrize(
    ("kind", "claim", "old", "new"), SPOILED, ids=[f"{kind}: {says}" for kind, says, _, _ in SPOILED]
)
def test_each_way_to_spoil_a_part_breaks_its_claim(kind: str, claim: str, old: str, new: str, tmp_path: Path) -> None:
    text = starter_text(kind, "spoiled")
    assert old in text
    (tmp_path / "spoiled.py").write_text(text.replace(old, new))
    (entry,) = parts_of(tmp_path / "spoiled.py")
    claims = claims_of(entry, example(entry.part.Params))
    tried = claims if kind == "generator" else [each for each in claims if each.says.startswith(claim)]
    (outcome,) = (each for each in try_claims(tried) if each.says.startswith(claim))
    assert not outcome.passed
    assert outcome.problem


@pytest.mark.parametrize(
    ("claim", "old", "new"),
    [
        ("a bond that is pulled breaks", "return state.largest / c.eps_f", "return min(state.largest / c.eps_f, 0.9)"),
        ("no loading is stiffer", "kept = max(c.eps_0 *", "kept = max((50.0 if peak > 2e-3 else 1.0) * c.eps_0 *"),
        ("loads are the", "return beam_energy(strain, load(strain, c, state))", "return c.axial * strain.axial**2"),
    ],
)  # fmt: skip
def test_a_law_whose_state_grows_from_the_first_strain_is_tried_up_to_where_it_breaks(
    claim: str, old: str, new: str, tmp_path: Path
) -> None:
    text = (Path(__file__).parents[3] / "docs" / "examples" / "my_law.py").read_text()
    assert old in text
    (tmp_path / "spoiled.py").write_text(text.replace(old, new))
    entry = next(each for each in parts_of(tmp_path / "spoiled.py") if each.kind == "bond_model")
    claims = [each for each in claims_of(entry, example(entry.part.Params)) if each.says.startswith(claim)]
    (outcome,) = try_claims(claims)
    assert not outcome.passed


def test_a_record_of_the_wrong_shape_is_told_once_with_its_file(tmp_path: Path) -> None:
    text = starter_text("bond_model", "spoiled").replace("shear=scale(c.shear, strain.shear)", "shear=c.shear")
    (tmp_path / "spoiled.py").write_text(text)
    with pytest.raises(AssertionError) as told:
        assert_contract(tmp_path / "spoiled.py")
    assert len(str(told.value).splitlines()) == 1
    assert re.search(r"spoiled.py:\d+: load: 'shear' must be a tuple of 3 numbers, given", str(told.value))


def test_what_a_law_raises_is_told_with_its_file_and_line(tmp_path: Path) -> None:
    text = starter_text("bond_model", "spoiled").replace(
        "    return max(strain.axial", "    oops()\n    return max(strain.axial"
    )
    (tmp_path / "spoiled.py").write_text(text)
    line = text[: text.index("    oops()")].count("\n") + 1
    with pytest.raises(
        AssertionError, match=rf"spoiled.py:{line}: failure raised NameError: name 'oops' is not defined"
    ):
        assert_contract(tmp_path / "spoiled.py")


def test_a_part_that_breaks_a_claim_fails_the_test_of_its_author(tmp_path: Path) -> None:
    text = starter_text("integrator", "spoiled").replace("order=2", "order=3")
    (tmp_path / "spoiled.py").write_text(text)
    with pytest.raises(AssertionError, match=r"spoiled: an oscillator follows .*: the order is 2.00, 3 is told"):
        assert_contract(tmp_path / "spoiled.py")


def test_a_parameter_without_a_description_is_a_remark_and_no_failure(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = starter_text("stop", "terse").replace(', description="Stress at which the run ends"', "")
    (tmp_path / "terse.py").write_text(text)
    assert check(str(tmp_path / "terse.py"))
    assert "remark  no description of stress: with Field(description=...)" in capsys.readouterr().out
    assert check(str(tmp_path / "terse.py"), as_json=True)
    assert len(json.loads(capsys.readouterr().out)[0]["remarks"]) == 1


def test_a_state_that_nothing_changes_is_a_remark() -> None:
    entry = next(each for each in discover() if (each.kind, each.name) == ("bond_model", "elastic_plastic"))
    forgetful = replace(entry, part=replace(entry.part, flow=None, on_event=None))
    (remark,) = remarks_on(forgetful)
    assert "neither 'flow' nor 'on_event'" in remark


def test_every_parameter_of_clast_and_of_its_starting_files_is_described(tmp_path: Path) -> None:
    started = []
    for kind in KINDS:
        (tmp_path / f"{kind}.py").write_text(starter_text(kind, f"my_{kind}"))
        started += parts_of(tmp_path / f"{kind}.py")
    assert [remark for entry in [*discover(), *started] for remark in remarks_on(entry)] == []
