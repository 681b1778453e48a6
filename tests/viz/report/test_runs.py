"""A report is one page that tells what a run gave, loads nothing, and cannot be broken by what a run is called."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from click.testing import CliRunner, Result

from clast import load, run_scene
from clast.cli import main
from tests.scenes import COLLISION, CRUSH, write
from tests.viz.report.page import Page
from tests.viz.synthetic_run import REFERENCE, small_grain, two_spheres, write_run

HOSTILE = '<script>alert("a")</script><img src=x onerror=b()> $\\frac$ & \x01 _'


def report(*arguments: Any) -> Result:
    return CliRunner().invoke(main, ["report", *map(str, arguments)])


def page_of(*arguments: Any) -> Page:
    result = report(*arguments)
    assert result.exit_code == 0, result.output
    return Page(Path(result.output.splitlines()[-1]))


@pytest.fixture(scope="module")
def crushed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a small crush, with its ledger."""
    folder = tmp_path_factory.mktemp("crushed")
    reference = {k: v for k, v in REFERENCE.items() if k != "label"} | {"label": "measured grains"}
    scene = load(write(folder, CRUSH)).changed(
        {"output.ledger": True, "description": "A small grain.", "reference": [reference]}
    )
    return run_scene(scene, folder / "run").folder


def changed(folder: Path, into: Path, config: dict[str, Any], summary: dict[str, Any] | None = None) -> Path:
    """Return a copy of a run with other values in its config and its summary."""
    shutil.copytree(folder, into, ignore=shutil.ignore_patterns("report.html"))
    said = yaml.safe_load((into / "config.yaml").read_text(encoding="utf-8"))
    (into / "config.yaml").write_text(yaml.safe_dump(said | config), encoding="utf-8")
    told = json.loads((into / "summary.json").read_text(encoding="utf-8"))
    (into / "summary.json").write_text(json.dumps(told | (summary or {})), encoding="utf-8")
    return into


def test_a_report_tells_what_the_summary_tells(crushed: Path) -> None:
    summary, page = json.loads((crushed / "summary.json").read_text()), page_of(crushed)
    assert f"{summary['peak_stress_Pa'] / 1e6:.3f} MPa at {summary['strain_at_peak']:.2%}" in page.rows["peak stress"]
    assert page.rows["fragments"] == [str(summary["fragments"])]
    assert f"{summary['bonds_broken']} of {summary['counts']['bonds']}" in page.text
    assert page.rows["materials.glass.young_modulus"] == ["4.2e8"]
    for told in (
        "small",
        "A small grain.",
        "measured grains",
        "measured 4.05 ± 1.45 MPa",
        "python 3",
        "elastic: bonds",
    ):
        assert told in page.text
    assert {"curves", "fragments", "energy", "cracks", "files"} <= set(page.ids)
    assert page.tags.count("figure") == 5


def test_a_report_lies_in_the_folder_of_its_run_and_is_the_same_each_time(crushed: Path) -> None:
    assert report(crushed).output == f"{crushed / 'report.html'}\n"
    first = (crushed / "report.html").read_bytes()
    report(crushed)
    assert (crushed / "report.html").read_bytes() == first


def test_a_page_loads_nothing_and_links_to_what_is_there(crushed: Path, tmp_path: Path) -> None:
    page = page_of(crushed, "-o", tmp_path / "pages" / "a page.html")
    assert page.foreign == []
    assert "://" not in page.source
    assert not {"script", "link", "iframe", "object", "base"} & set(page.tags)
    assert len(set(page.ids)) == len(page.ids)
    linked = [each for each in page.loaded if not each.startswith(("#", "data:"))]
    assert len(linked) > 3
    assert all((tmp_path / "pages" / each).exists() for each in linked)
    assert all(each[1:] in page.ids for each in page.loaded if each.startswith("#"))


def test_what_users_write_stays_text(crushed: Path, tmp_path: Path) -> None:
    hostile = {
        "description": HOSTILE,
        "reference": [{"label": HOSTILE, "strain": 0.1, "stress": 1e6}],
        "materials": {HOSTILE: {"density": HOSTILE}},
    }
    folder = changed(crushed, tmp_path / "<b>run</b>", hostile, {"time_step_warning": HOSTILE})
    page, harmless = page_of(folder), page_of(crushed)
    assert {tag: page.tags.count(tag) for tag in ("script", "img", "b")} == {"script": 0, "img": 0, "b": 0}
    assert page.tags.count("svg") == harmless.tags.count("svg")
    assert page.text.count('<script>alert("a")</script>') > 5
    assert "\x01" not in page.source


def test_a_picture_stands_in_the_page_itself(crushed: Path, tmp_path: Path) -> None:
    folder = changed(crushed, tmp_path / "run", {})
    (folder / "picture.png").write_bytes(b"\x89PNG picture")
    assert "data:image/png;base64,iVBORyBwaWN0dXJl" in page_of(folder).loaded


def test_several_runs_lie_over_each_other_and_what_differs_is_told(crushed: Path, tmp_path: Path) -> None:
    particles = yaml.safe_load((crushed / "config.yaml").read_text())["particles"]
    other = changed(crushed, tmp_path / "other", {"particles": particles | {"seed": 4}}, {"fragments": 77})
    page = page_of(crushed, other, crushed, "-o", tmp_path / "both.html")
    assert page.rows["particles.seed"] == ["3", "4"]
    assert page.rows["fragments"][1] == "77"
    assert "particles.porosity" in page.rows  # folded, for each run
    assert "small: 2 runs" in page.text
    assert page.source.count("#ee6677") > 4
    assert page.source.count("#228833") > 4


def test_equal_runs_are_said_to_be_equal(crushed: Path, tmp_path: Path) -> None:
    page = page_of(crushed, changed(crushed, tmp_path / "run", {"name": "x"}), "-o", tmp_path / "both.html")
    assert "the scenes are the same in every value" in page.text
    assert f"{crushed.parent.name}/run" in page.text
    assert f"{tmp_path.name}/run" in page.text


def test_a_run_without_bonds_ledger_and_compression_says_so(tmp_path: Path) -> None:
    folder = run_scene(load(write(tmp_path, COLLISION)), tmp_path / "run").folder
    page = page_of(folder)
    for told in ("No stress–strain curve", "No fragments", "No energies", "No bond broke"):
        assert told in page.text
    assert "svg" not in page.tags


def test_bonds_without_compression_are_drawn_over_time(tmp_path: Path) -> None:
    scene = small_grain()
    curves = {
        name: values for name, values in scene.curves.items() if name in ("time_s", "bonds_intact", "bonds_broken")
    }
    page = page_of(write_run(tmp_path / "run", scene._replace(curves=curves)))
    assert "Bonds broken over time" in page.text
    assert "time [ms]" in page.text


def test_what_a_tube_carries_is_drawn_with_the_lateral_pressure_coefficient(tmp_path: Path) -> None:
    scene = small_grain()
    stress = scene.curves["stress_Pa"]
    side = {"stress_lower_Pa": 0.8 * stress, "stress_side_Pa": 0.4 * stress}
    side["lateral_pressure_coefficient"] = np.where(stress > 0.0, 0.4 / 0.9, 0.0)
    tube = write_run(tmp_path / "tube", scene._replace(curves={**scene.curves, **side}))
    title = "Stress on plates and side, and lateral pressure coefficient"
    page = page_of(tube)
    assert title in page.text
    for name in ("upper wall", "lower wall", "side"):
        assert f">{name}<" in page.source or name in page.text
    assert title not in page_of(write_run(tmp_path / "plates", scene)).text


def test_a_run_that_has_not_ended_is_shown_as_far_as_it_came(tmp_path: Path) -> None:
    folder = write_run(tmp_path / "run", small_grain(), complete=False)
    (folder / "summary.json").unlink()
    page = page_of(folder)
    assert "The run has not come to its end" in page.text
    assert page.rows["peak stress"] == ["4.186 MPa at 17.95%"]
    assert page.tags.count("figure") == 4


def test_a_run_that_has_only_begun_says_so(tmp_path: Path) -> None:
    whole = small_grain()
    begun = whole._replace(
        frames={name: values[:1] for name, values in whole.frames.items()},
        curves={name: values[:1] for name, values in whole.curves.items()},
        cracks={name: values[:0] for name, values in whole.cracks.items()},
    )
    page = page_of(write_run(tmp_path / "run", begun, complete=False))
    assert page.rows["simulated until"] == ["0 s"]
    assert page.tags.count("figure") == 1
    assert "No stress–strain curve" in page.text


def test_a_summary_of_another_version_costs_the_summary_only(tmp_path: Path) -> None:
    page = page_of(write_run(tmp_path / "run", two_spheres()))
    assert "no summary that this version can read" in page.text
    assert page.rows["particles, bonds"] == ["2, 0"]


@pytest.mark.parametrize(
    ("told", "warning"),
    [
        ({"particles_removed": 3}, "3 particles left the domain"),
        ({"warnings": ["the bed ends 3 mm below"]}, "the bed ends 3 mm below"),
        ({"peak_inside_run": False}, "need not be the peak"),
        ({"time_step_warning": "the step was 1.2 of the limit"}, "the step was 1.2 of the limit"),
        ({"energy": {"closure": -0.25, "incomplete": None}}, "no better than 25.0% of the work"),
        ({"energy": {"closure": 0.0, "incomplete": "the law is silent"}}, "Energy ledger: the law is silent."),
        ({"energy": {"closure": 0.0, "quasi_static": False}}, "Not quasi-static before the peak"),
    ],
)
def test_warnings_come_first(crushed: Path, tmp_path: Path, told: dict[str, Any], warning: str) -> None:
    page = page_of(changed(crushed, tmp_path / "run", {}, told))
    assert warning in page.text
    assert page.text.index(warning) < page.text.index("Summary")


def test_a_sound_run_has_no_warning(crushed: Path, tmp_path: Path) -> None:
    assert (
        "alert"
        not in page_of(changed(crushed, tmp_path / "run", {}, {"peak_inside_run": True})).source.split("<main>")[1]
    )


def test_a_damaged_run_is_told_and_the_others_are_shown(crushed: Path, tmp_path: Path) -> None:
    damaged = changed(crushed, tmp_path / "damaged", {})
    (damaged / "results.h5").write_bytes((crushed / "results.h5").read_bytes()[:3000])
    result = report(crushed, damaged, "-o", tmp_path / "both.html")
    assert result.exit_code == 0
    assert result.output.startswith(f"cannot be read: {damaged / 'results.h5'}: cannot be read (")
    page = Page(tmp_path / "both.html")
    assert "the file is damaged or cut short" in page.text
    assert page.rows["fragments"][1] == ""
    assert page.tags.count("figure") == 5
    assert "There are no numbers to show." in page_of(damaged).text


def test_a_damaged_frame_costs_the_fragments_only(tmp_path: Path) -> None:
    import h5py

    folder = write_run(tmp_path / "run", small_grain())
    with h5py.File(folder / "results.h5", "a") as file:
        del file["frames/velocity"]
    page = page_of(folder)
    assert "frame 0: " in page.text
    assert page.tags.count("figure") == 2


def test_a_folder_that_is_no_run_is_one_message(crushed: Path, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    for folder, told in ((tmp_path / "none", "not there"), (tmp_path, "not a run folder, it holds no results.h5")):
        result = report(crushed, folder, "-o", page)
        assert (result.exit_code, result.stdout) == (2, "")
        assert result.stderr.startswith(f"{folder}: {told}")
        assert result.stderr.count("\n") == 1
    assert not page.exists()


def test_a_page_that_cannot_be_written_is_one_message(crushed: Path, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    result = report(crushed, "-o", tmp_path / "file" / "page.html")
    assert result.exit_code == 1
    assert str(tmp_path / "file") in result.stderr
    assert result.stderr.count("\n") == 1
