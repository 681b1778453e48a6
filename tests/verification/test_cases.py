"""Every case of the suite passes, and its scene is one that users can run."""

import tomllib
from pathlib import Path

import pytest

import clast.verification
from clast.config.scene import load
from clast.verification.bench import IN_THE_SOURCES, INSTALLED, Bench, scene_file
from clast.verification.examine import PASSED, examine
from clast.verification.suite import FAMILIES

CASES = [case for family in FAMILIES for case in family.cases]
OTHERS = [case for family in FAMILIES for case in family.cases[1:]]
"""All but the first of each family: ``clast verify`` runs them all, too."""
ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    "case", [pytest.param(each, marks=[pytest.mark.long] if each in OTHERS else [], id=each.name) for each in CASES]
)
def test_a_case_finds_what_it_should(case):
    outcome = examine(case, Bench(case.config))
    assert [found for found in outcome.findings if not found.passed] == []
    assert (outcome.verdict, outcome.stopped) == (PASSED, "")


def test_names_are_unique():
    for names in ([case.name for case in CASES], [family.name for family in FAMILIES]):
        assert len(set(names)) == len(names)


def test_every_scene_is_valid_and_belongs_to_a_case():
    files = sorted((ROOT / "configs" / "verification").glob("*.yaml"))
    assert {file.stem for file in files} == {case.config for case in CASES}
    for file in files:
        assert load(file).name == file.stem


def test_a_wheel_holds_the_scenes_where_they_are_looked_for():
    """What the build copies into the package is what the sources use."""
    build = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["hatch"]["build"]
    target = build["targets"]["wheel"]["force-include"][IN_THE_SOURCES.relative_to(ROOT).as_posix()]
    package = Path(clast.verification.__file__).parents[1]
    assert package.parent / target == INSTALLED


def test_an_installed_package_has_its_own_scenes(tmp_path, monkeypatch):
    monkeypatch.setattr("clast.verification.bench.INSTALLED", tmp_path)
    assert scene_file("some").parent == tmp_path
