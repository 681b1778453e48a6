"""The report of a calibration shows what was fitted, how well, how surely, and the points on the way."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from clast.cli import main
from tests.core.calibration.test_calibration import GLASS, calibrate, calibration_file
from tests.viz.report.page import Page

ASKED = """calibration: small grain <i>
description: Fitted to <b>measurements</b>
base: grain.yaml
parameters:
  modulus: {keys: [materials.glass.young_modulus], from: 1 MPa, to: 9 MPa}
targets: {peak_force_N: {value: 14.81 N}, strain_at_peak: {value: 16.5 %}}
budget: 8
"""
RUNS = """run,variant,point,repeat,modulus,state,reason,peak_force_N
a-1,,0,0,1500000.0,done,,14.1
a-2,,0,1,1500000.0,failed,"energy came from <b>nowhere</b>",
b-1,,1,0,2500000.0,done,,15.1
"""
HISTORY = """point,modulus,peak_force_N,error of peak_force_N,misfit
0,1500000.0000000002,14.1,0.4,2.25
1,2500000.0,15.1,0.3,0.16
"""
ACCOUNT: dict[str, Any] = {
    "name": "small grain <i>",
    "description": "Fitted to <b>measurements</b>",
    "points": 2,
    "repeats": 2,
    "runs": 3,
    "failed": 1,
    "best": 1,
    "parameters": {
        "heads": ["parameter (SI)", "range", "fitted", "standard deviation"],
        "rows": [["modulus", "1e+06 to 9e+06", "2.5e+06", "± 3e+05"]],
    },
    "targets": {
        "heads": ["target (SI)", "wanted ± within", "runs there", "by all runs", "off, in tolerances"],
        "rows": [
            ["peak_force_N", "14.81 ± 0.74", "15.1 ± 0.3", "15.1 ± 0.2", "+0.39"],
            ["strain_at_peak", "0.165 ± 0.008", "0.15 ± 0.001", "0.15 ± 0.001", "-1.88"],
        ],
    },
    "sensitivities": {
        "heads": ["tolerances over the whole range", "modulus"],
        "rows": [["peak_force_N", "+7.5"], ["strain_at_peak", "+0.1"]],
    },
    "distances": [0.39, -1.88],
    "left_open": ["<b>modulus</b> is hardly determined."],
}


def report(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["report", *map(str, arguments)])


def page_of(folder: Path) -> Page:
    """Report a calibration and read the page."""
    result = report(folder)
    assert (result.exit_code, result.output) == (0, f"{folder / 'report.html'}\n")
    return Page(folder / "report.html")


@pytest.fixture
def begun(tmp_path: Path) -> Path:
    folder = tmp_path / "calibration"
    for name in ("a-1", "b-1"):
        (folder / "runs" / name).mkdir(parents=True)
    (folder / "calibration.yaml").write_text(ASKED, encoding="utf-8")
    return folder


@pytest.fixture
def ended(begun: Path) -> Path:
    for name, text in (("runs.csv", RUNS), ("history.csv", HISTORY), ("account.json", json.dumps(ACCOUNT))):
        (begun / name).write_text(text, encoding="utf-8")
    (begun / "fitted.yaml").write_text("name: grain\n", encoding="utf-8")
    (begun / "fit.png").write_bytes(b"\x89PNG picture")
    return begun


def changed(folder: Path, **keys: Any) -> Path:
    (folder / "account.json").write_text(json.dumps(ACCOUNT | keys), encoding="utf-8")
    return folder


def test_targets_are_coloured_by_their_distance_in_tolerances(ended: Path) -> None:
    page = page_of(ended)
    assert page.rows["peak_force_N"] == ["14.81 ± 0.74", "15.1 ± 0.3", "15.1 ± 0.2", "+0.39"]
    assert '<td class="good">+0.39</td>' in page.source
    assert '<td class="bad">-1.88</td>' in page.source
    assert '<dt>targets met</dt><dd class="good">1</dd>' in page.source
    assert '<dt>targets not met</dt><dd class="bad">1</dd>' in page.source


def test_parameters_sensitivities_and_what_is_left_open_are_told(ended: Path) -> None:
    page = page_of(ended)
    assert page.rows["modulus"] == ["1e+06 to 9e+06", "2.5e+06", "± 3e+05"]
    assert ["tolerances over the whole range", "modulus"] in page.cells
    assert ["strain_at_peak", "+0.1"] in page.cells
    assert "<b>modulus</b> is hardly determined" in page.text
    assert page.rows["parameters.modulus.from"] == ["1 MPa"]
    determined = page_of(changed(ended, left_open=[]))
    assert "Nothing: every parameter has an influence of its own" in determined.text


def test_points_runs_and_files_can_be_reached(ended: Path) -> None:
    page = page_of(ended)
    assert page.rows["point"] == ["modulus", "peak_force_N", "error of peak_force_N", "misfit"]
    assert ["0", "1.5e6", "14.1", "0.4", "2.25"] in page.cells
    assert "number 1 was chosen" in page.text
    assert page.rows["a-1"] == ["0", "1.5e6", "0", "done"]
    assert {"runs/a-1/", "runs/b-1/", "fitted.yaml", "calibration.yaml"} <= set(page.loaded)
    assert {"runs/a-2/", "calibration.md"}.isdisjoint(page.loaded)
    assert "data:image/png;base64,iVBORyBwaWN0dXJl" in page.loaded
    assert "1 of 3 runs are not done" in page.text
    assert "a-2: failed, energy came from <b>nowhere</b>" in page.text


def test_what_users_write_stays_text(ended: Path) -> None:
    page = page_of(ended)
    for told in ("small grain <i>", "Fitted to <b>measurements</b>"):
        assert told in page.text
    assert page.foreign == []
    assert not {"i", "b", "script", "link"} & set(page.tags)
    assert len(set(page.ids)) == len(page.ids)


def test_a_calibration_that_has_not_ended_says_so(begun: Path) -> None:
    page = page_of(begun)
    assert "The calibration has not come to its end" in page.text
    assert "2 runs have begun" in page.text
    assert {"runs/a-1/", "runs/b-1/"} <= set(page.loaded)
    assert page.rows["parameters.modulus.to"] == ["9 MPa"]
    assert {"targets", "fitted", "history"}.isdisjoint(page.ids)


def test_what_a_calibration_really_writes_can_be_read(tmp_path: Path) -> None:
    file = calibration_file(tmp_path, targets={"peak_force_N": {"value": 4.7}}, budget=6)
    assert calibrate(file, tmp_path / "out").exit_code == 0
    page = page_of(tmp_path / "out")
    assert page.rows[GLASS][0] == "1e+08 to 1e+09"
    assert [row[0] for row in page.cells if len(row) == 5 and row[0].isdigit()] == ["0", "1", "2", "3", "4", "5"]
    assert {"fitted.yaml", "calibration.md", "account.json", "history.csv", "runs.csv"} <= set(page.loaded)
    assert sum(each.startswith("runs/") for each in page.loaded) == 6
    assert "alert" not in page.source.split("<main>")[1]


def test_a_calibration_comes_alone(ended: Path) -> None:
    result = report(ended, ended / "runs" / "a-1")
    assert result.exit_code == 2
    assert "give its folder alone" in result.stderr


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("account.json", b"{", "account.json: cannot be read (Invalid JSON"),
        ("account.json", b"{}", "cannot be read (name: Field required)"),
        ("account.json", json.dumps(ACCOUNT | {"distances": [1.0]}).encode(), "every target needs one distance"),
        ("account.json", json.dumps(ACCOUNT | {"targets": {"heads": [], "rows": [["a"]]}}).encode(), "as many cells"),
        ("history.csv", b"point\n", "history.csv: cannot be read (it has no column misfit); run `clast calibrate`"),
        ("calibration.yaml", b"a: [", "calibration.yaml: cannot be read"),
    ],
)
def test_a_broken_file_is_one_message(ended: Path, name: str, content: bytes, told: str) -> None:
    (ended / name).write_bytes(content)
    result = report(ended)
    assert result.exit_code == 2
    assert told in result.stderr
    assert result.stderr.count("\n") == 1
    assert not (ended / "report.html").exists()
