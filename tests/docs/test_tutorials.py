"""The tutorials do what they say: every block of ``bash`` and ``python`` in them is run, in the order of the page.

A block that is only to be looked at is marked ``console``; one after "Save this as `NAME`:" is written to that file.
"""

import re
import shlex

import numpy as np
import pytest
from click.testing import CliRunner

import clast
from clast.cli import main
from tests.docs.test_examples import DOCS, ROOT

TUTORIALS = DOCS / "tutorials"
_BLOCK = re.compile(r"(?:Save this as `(?P<file>[\w.]+)`:\n\n)?```(?P<language>\w+)\n(?P<text>.*?)```", re.DOTALL)


@pytest.fixture
def desk(tmp_path, monkeypatch):
    """A working folder that has the ready scenes."""
    (tmp_path / "configs").symlink_to(ROOT / "configs")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def follow(name):
    """Do what a tutorial says in the working folder; return what its Python has defined."""
    page = (TUTORIALS / f"{name}.md").read_text(encoding="utf-8")
    known = {}
    for block in _BLOCK.finditer(page):
        if block["file"]:
            with open(block["file"], "w", encoding="utf-8") as file:
                file.write(block["text"])
        if block["language"] == "python":
            exec(compile(block["text"], f"{name}.md", "exec"), known)
        elif block["language"] == "bash":
            for command in block["text"].splitlines():
                order(command)
    return known


def order(command):
    """Give a command of Clast as in a shell."""
    program, *arguments = shlex.split(command)
    assert program == "clast"
    told = CliRunner().invoke(main, arguments, catch_exceptions=False)
    assert told.exit_code == 0, f"{command}: {told.output}"


def test_a_grain_is_crushed_read_and_looked_at_as_the_tutorials_say(desk):
    follow("first-crush")
    for name in ("stress_strain.png", "summary.json", "curves.csv", "results.h5"):
        assert (desk / "runs" / "coarse" / name).stat().st_size > 0
    with clast.open_run("runs/coarse") as coarse, clast.open_run("runs/tough") as tough:
        assert tough.curves["stress_Pa"].max() > coarse.curves["stress_Pa"].max()
    assert "bonds.model.yield_stress" in (desk / "both.html").read_text(encoding="utf-8")

    read = follow("read-results")
    assert read["stress"][read["peak"]] == clast.open_run("runs/coarse").summary["peak_stress_Pa"]
    assert 0.0 < read["intact"][-1] < 1.0

    shown = follow("look-at-a-run")
    assert (desk / "runs" / "coarse" / "recording.rrd").is_file()
    assert len(shown["moments"]) == read["run"].n_frames
    assert shown["first"].n_points == len(read["run"].radius)


def test_the_contact_law_of_the_tutorial_gives_back_what_it_says(desk, capsys):
    law = follow("write-a-contact-law")
    assert law["restitution"] == pytest.approx(np.sqrt(10 / 40), rel=2e-3)
    assert "takes 75% of the work" in capsys.readouterr().out


def test_the_bond_model_of_the_tutorial_pulls_along_its_parabola_and_comes_back_straight(desk):
    law = follow("write-a-bond-model")
    told = law["pulled"]
    strain, held = told["axial_strain"], told["intact"] > 0
    assert strain[held].max() == pytest.approx(0.004, rel=0.03)
    assert not held[-1]
    parabola = 100e6 * (1 - strain / 0.004) * strain
    assert told["normal_stress"][held] == pytest.approx(parabola[held], rel=1e-9)
    assert law["stress"].max() == pytest.approx(100e6 * 0.004 / 4, rel=1e-9)
    assert law["stress"][45] == pytest.approx(law["stress"][30] * law["path"][45] / law["path"][30], rel=1e-9)
    assert (desk / "weakening.png").stat().st_size > 1000


def test_the_tutorial_on_fig_9_prepares_every_run_and_quotes_the_study(desk):
    follow("reproduce-fig-9")
    assert len(list((desk / "runs" / "fig09_prepared").rglob("*.yaml"))) >= 24
    page = (TUTORIALS / "reproduce-fig-9.md").read_text(encoding="utf-8")
    study = (ROOT / "configs" / "paper" / "fig09.yaml").read_text(encoding="utf-8")
    (quoted,) = re.findall(r"```yaml\n(.*?)```", page, re.DOTALL)
    for line in quoted.splitlines():
        assert line.split("  #")[0].strip() in study


def test_every_tutorial_is_followed_by_a_test():
    tests = (ROOT / "tests" / "docs" / "test_tutorials.py").read_text(encoding="utf-8")
    for page in TUTORIALS.glob("*.md"):
        assert f'follow("{page.stem}")' in tests
