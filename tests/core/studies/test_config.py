"""A study file that says something wrong is told where, what, and what to do."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from clast.errors import ConfigError
from clast.studies.config import load_study
from clast.studies.design import points
from clast.studies.tasks import tasks
from tests.core.studies.support import study, study_file
from tests.scenes import COLLISION, CRUSH, write

YIELD = "bonds.model.yield_stress"
STATEMENT = {"says": "x", "check": "equals", "measure": "peak_stress_Pa", "value": "3 MPa"}


NAN = float("nan")
DRAWN = {"distribution": "normal", "mean": "5 MPa", "deviation": "0.1 MPa"}


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({"vary": {YIELD: []}}, "vary.bonds.model.yield_stress"),
        ({"vary": {YIELD: {"from": "1 MPa"}}}, "a range needs 'from' and 'to'"),
        ({"vary": {YIELD: {"from": "1 MPa", "to": 3, "values": [1]}}}, "give one of"),
        ({"vary": {YIELD: {"from": "1 MPa", "to": "3 mm", "points": 3}}}, "not of one dimension"),
        ({"vary": {YIELD: {"from": "0 MPa", "to": "3 MPa", "points": 3, "spacing": "log"}}}, "none of them 0"),
        ({"vary": {YIELD: {"from": "1 MPa", "to": "3 MPa"}}}, "a range without 'points' needs a design that draws"),
        ({"vary": {YIELD: {"distribution": "normal", "mean": 1, "deviation": 2}}}, "a distribution needs a design"),
        ({"vary": {YIELD: {"distribution": "normal", "mean": 1}}}, "needs 'mean' and 'deviation'"),
        ({"vary": {YIELD: [1]}, "design": "sobol"}, "design 'sobol' needs 'points'"),
        ({"vary": {YIELD: [1]}, "points": 3}, "'points' belongs to the designs"),
        ({"vary": {YIELD: ["1 MPa", "2 MPa"], "particles.seed": [1]}, "design": "together"}, "as many values on every"),
        ({"vary": {"bonds.model.yield_stres": ["1 MPa"]}}, "did you mean 'yield_stress'?"),
        ({"vary": {"bnods.model": ["1 MPa"]}}, "bnods"),
        ({"vary": {YIELD: ["1 mm"]}}, "'1 mm' is a length; a stress is needed"),
        ({"set": {"time.end.strain": -1}}, "set: "),
        ({"variants": {"weak": {YIELD: "x"}}}, "variants.weak: "),
        ({"vary": {"m": {"keys": {YIELD: 2}, "values": ["soft"]}}}, "cannot be multiplied"),
        ({"vary": {"m": {"scales": ["bonds.damping"], "values": [2]}}}, "nothing to multiply"),
        ({"vary": {"m": {"scales": [YIELD], "keys": [YIELD], "values": [2]}}}, "give one of them"),
        (
            {
                "vary": {
                    YIELD: {"from": 1, "to": 2, "points": 400},
                    "bonds.damping": {"from": 0, "to": 1, "points": 400},
                }
            },
            "160,000 runs, where a study may have 100,000",
        ),
        ({"vary": {YIELD: {"from": "1 mm", "to": "3 mm", "points": 2}}}, "is a length; a stress is needed"),
        ({"vary": {YIELD: [1]}, "variants": {"a": {YIELD: 2}}}, f"axis '{YIELD}' sets this key at every point"),
        ({"vary": {YIELD: ["1 MPa"]}, "expect": [STATEMENT | {"where": {YIELD: "9 MPa"}}]}, "they are 1 MPa"),
        ({"vary": {YIELD: ["1 MPa"]}, "expect": [STATEMENT | {"where": {YIELD: "1 mm"}}]}, "which is a stress"),
        ({"vary": {YIELD: ["1 MPa"]}, "expect": [STATEMENT | {"value": "3 mm"}]}, "is a length; a stress is needed"),
        ({"repeets": 2}, "did you mean 'repeats'?"),
        ({"grain": "any"}, "'per_repeat'"),
        ({"expect": [{"says": "x", "check": "grows"}]}, "needs a 'measure'"),
        ({"expect": [{"says": "x", "check": "equals", "measure": "drops"}]}, "'value' belongs to 'equals'"),
        ({"expect": [{"says": "x", "check": "larger", "measure": "drops"}]}, "'than' belongs to"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(tmp_path: Path, keys: dict[str, Any], told: str) -> None:
    with pytest.raises(ConfigError) as caught:
        tasks(study(tmp_path, **keys))
    assert told in str(caught.value)
    assert "try.yaml" in str(caught.value)


def test_a_base_that_is_not_there_is_told(tmp_path: Path) -> None:
    file = study_file(tmp_path)
    (tmp_path / "base.yaml").unlink()
    with pytest.raises(ConfigError, match=r"base: 'base\.yaml': no such file"):
        load_study(file)


def test_statements_about_axes_that_do_not_exist_are_refused(tmp_path: Path) -> None:
    expect = [{"says": "x", "check": "grows", "measure": "drops", "along": "bonds.model.yield"}]
    with pytest.raises(ConfigError, match=r"expect\.0\.along: .*did you mean 'bonds\.model\.yield_stress'"):
        study(tmp_path, vary={YIELD: [1e6]}, expect=expect)
    expect = [{"says": "x", "check": "same", "measure": "peak", "where": {YIELD: 1e6}}]
    with pytest.raises(ConfigError, match=r"expect\.0\.measure: .*'peak'"):
        study(tmp_path, vary={YIELD: [1e6]}, expect=expect)


def test_a_measure_that_the_scene_cannot_have_is_told(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"has no 'compression', so there is no peak_stress_Pa"):
        study(tmp_path, COLLISION, expect=[STATEMENT])


def test_a_scene_that_is_taken_for_a_study_is_told(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"this is a scene, not a study of one; run it with 'clast run"):
        load_study(write(tmp_path, CRUSH))


def test_a_study_without_axes_is_repeats_alone(tmp_path: Path) -> None:
    assert points(study(tmp_path)) == [()]
    assert len(tasks(study(tmp_path, repeats=3, grain="per_repeat"))) == 3


@pytest.mark.parametrize(
    ("keys", "place"),
    [
        ({"vary": {YIELD: {"from": NAN, "to": 3, "points": 2}}}, f"vary.{YIELD}.from"),
        ({"vary": {YIELD: DRAWN | {"mean": NAN}}, "design": "sobol", "points": 4}, f"vary.{YIELD}.mean"),
        ({"vary": {"m": {"keys": {YIELD: NAN}, "values": [1]}}}, f"vary.m.keys.{YIELD}"),
        ({"vary": {"m": {"keys": [YIELD], "values": NAN}}}, "vary.m.values"),
        ({"vary": {YIELD: [1]}, "expect": [STATEMENT | {"value": NAN}]}, "expect.0.value"),
        ({"vary": {YIELD: [1]}, "expect": [STATEMENT | {"where": {YIELD: NAN}}]}, f"expect.0.where.{YIELD}"),
        ({"vary": {YIELD: [1]}, "expect": [STATEMENT | {"where": {YIELD: {"above": NAN}}}]}, f"where.{YIELD}.above"),
    ],
)
def test_what_is_no_number_is_told_once(tmp_path: Path, keys: dict[str, Any], place: str) -> None:
    with pytest.raises(ConfigError) as caught:
        study(tmp_path, **keys)
    (line,) = str(caught.value).splitlines()
    assert place in line
    assert line.endswith("given nan")


@pytest.mark.parametrize(
    ("kind", "cuts", "told"),
    [
        ("normal", {"at_least": "9 MPa"}, "at_least 9 MPa"),
        ("normal", {"at_most": "1 kPa"}, "at_most 1 kPa"),
        ("lognormal", {"at_most": "-3 MPa"}, "at_most -3 MPa"),
        ("weibull", {"at_most": "0 MPa"}, "at_most 0 MPa"),
        ("normal", {"at_least": "6 MPa", "at_most": "4 MPa"}, "at_least 6 MPa and at_most 4 MPa"),
    ],
)
def test_cut_offs_that_leave_nothing_of_a_distribution_are_told(
    tmp_path: Path, kind: str, cuts: dict[str, str], told: str
) -> None:
    drawn = DRAWN | {"distribution": kind} | cuts
    with pytest.raises(ConfigError, match=rf"vary\.{YIELD}: {told}: next to nothing of the distribution") as caught:
        tasks(study(tmp_path, vary={YIELD: drawn}, design="sobol", points=4))
    assert "inf" not in str(caught.value)


def test_cut_offs_that_leave_something_are_kept(tmp_path: Path) -> None:
    drawn = DRAWN | {"at_least": "5.05 MPa", "at_most": "5.1 MPa"}
    found = points(study(tmp_path, vary={YIELD: drawn}, design="random", points=40))
    assert all(5.05e6 <= (setting.number or 0.0) <= 5.1e6 for (setting,) in found)


@pytest.mark.parametrize("override", ["repeats=3", "vary.x=[1]", "set={}", "points=4"])
def test_what_the_study_alone_has_is_not_changed_on_the_command_line(tmp_path: Path, override: str) -> None:
    key = override.split("=")[0].split(".")[0]
    told = f"--set {override}: changes the scene that all runs start from, and {key!r} is no key of it; change it in "
    with pytest.raises(ConfigError) as caught:
        load_study(study_file(tmp_path, vary={YIELD: ["1 MPa"]}), [override])
    assert str(caught.value) == told + str(tmp_path / "try.yaml")


@pytest.mark.parametrize(
    "keys",
    [
        {"vary": {YIELD: ["1 MPa"]}},
        {"vary": {"strength": {"keys": [YIELD], "values": ["1 MPa"]}}},
        {"set": {YIELD: "1 MPa"}},
        {"variants": {"soft": {YIELD: "1 MPa"}}},
    ],
)
def test_what_the_study_sets_anyway_is_not_changed_on_the_command_line(tmp_path: Path, keys: dict[str, Any]) -> None:
    with pytest.raises(ConfigError, match=rf"--set {YIELD}=3 MPa: .*try\.yaml sets this key itself; change it there"):
        load_study(study_file(tmp_path, **keys), [f"{YIELD}=3 MPa"])


def test_a_change_on_the_command_line_reaches_every_run(tmp_path: Path) -> None:
    file = study_file(tmp_path, vary={YIELD: {"scales": [YIELD], "values": [1, 2]}})
    given = load_study(file, [f"{YIELD}=3 MPa", "output.frames=7"])
    scenes = [yaml.safe_load(each.scene) for each in tasks(given)]
    assert [scene["bonds"]["model"]["yield_stress"] for scene in scenes] == [3e6, 6e6]
    assert [scene["output"]["frames"] for scene in scenes] == [7, 7]
