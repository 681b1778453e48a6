"""A reproduction: studies run by one command, and a page of what holds."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml
from click.testing import CliRunner

from clast.cli import main
from clast.reproduce.manuscript import read_manuscript
from tests.core.studies.support import QUICK
from tests.scenes import CRUSH, write

PAGE = """# A page

<!-- statements -->

## Strength

<!-- study: strength -->

That is all.
"""
YIELD = "bonds.model.yield_stress"
SAYS = "strength grows"


def manuscript(folder: Path) -> Path:
    """Write a page, its study and its scene."""
    folder.mkdir()
    write(folder, CRUSH, "scene.yaml")
    expect = [{"says": SAYS, "check": "grows", "measure": "peak_stress_Pa"}]
    study = {"study": "strength", "base": "scene.yaml", "set": QUICK, "vary": {YIELD: ["1 MPa", "2 MPa"]}}
    write(folder, yaml.safe_dump(study | {"expect": expect}), "strength.yaml")
    write(folder, PAGE, "page.md")
    return folder


def reproduce(*arguments: Any) -> Any:
    """Call the command as a user does."""
    return CliRunner().invoke(main, ["reproduce", *map(str, arguments)])


def test_a_page_tells_figures_points_and_statements(tmp_path: Path) -> None:
    folder, page = manuscript(tmp_path / "book"), tmp_path / "out" / "page.md"
    page.parent.mkdir()
    told = reproduce(folder, "-o", page, "--runs", tmp_path / "runs")
    assert told.exit_code == 0, told.output
    text = page.read_text()
    assert "<!--" not in text
    assert f"| strength | {SAYS} | " in text
    assert f"| {YIELD} | runs |" in text
    assert text.endswith("That is all.\n")
    assert (page.parent / "img" / "book_strength.png").read_bytes().startswith(b"\x89PNG")


def test_what_is_not_run_yet_is_told(tmp_path: Path) -> None:
    folder, page = manuscript(tmp_path / "book"), tmp_path / "page.md"
    assert reproduce(folder, "-o", page, "--runs", tmp_path / "runs", "--collect").exit_code == 0
    assert "Of 2 runs: 2 not run." in page.read_text()
    assert f"| strength | {SAYS} | not run |" in page.read_text()


def test_runs_that_all_failed_are_told_with_their_reason_also_when_they_are_gathered_later(tmp_path: Path) -> None:
    folder, page = manuscript(tmp_path / "book"), tmp_path / "page.md"
    study = yaml.safe_load((folder / "strength.yaml").read_text())
    study["set"]["time.step"] = 1e-3
    write(folder, yaml.safe_dump(study), "strength.yaml")
    pages = []
    for options in ((), ("--collect",)):
        assert reproduce(folder, "-o", page, "--runs", tmp_path / "runs", *options).exit_code == 0
        pages.append(page.read_text())
    assert pages[0] == pages[1]
    assert f"| strength | {SAYS} | all runs failed |" in pages[0]
    assert "all 2 runs failed: time.step: 0.001 s is above the stability limit" in pages[0]
    assert str(tmp_path) not in pages[0]


def test_names_that_are_not_there_are_told(tmp_path: Path) -> None:
    told = reproduce("papre")
    assert told.exit_code == 2
    assert "'papre': nothing to reproduce; looked for papre/page.md or configs/papre/page.md" in told.output
    folder = manuscript(tmp_path / "book")
    told = reproduce(folder, "-o", tmp_path / "p.md", "--only", "strenght", "--collect")
    assert "did you mean 'strength'?" in told.output
    (folder / "strength.yaml").unlink()
    assert "there is no strength.yaml" in reproduce(folder).output


def test_the_paper_is_complete_and_every_study_of_it_valid() -> None:
    from clast.studies.config import load_study
    from clast.studies.tasks import tasks

    paper = read_manuscript("paper")
    files = {file.stem for file in paper.folder.glob("fig*.yaml") if file.read_text().count("\nstudy: ")}
    beds = {name for name in files if name.endswith(("_half", "_full"))}  # docs/oedometer.md is about these
    assert len(beds) == 6
    assert set(paper.studies) == files - beds
    for name in paper.studies:
        study = load_study(paper.file_of(name))
        assert study.study == name
        assert study.expect
        assert tasks(study)
