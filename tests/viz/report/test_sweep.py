"""The report of a sweep shows its study, points, verdicts and plots, and which runs are missing and why."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from clast.cli import main
from tests.scenes import COLLISION, write
from tests.viz.report.page import Page
from tests.viz.synthetic_run import small_grain, write_run

STUDY = """study: porosity <i>
description: What the porosity does
base: grain.yaml
vary:
  particles.porosity: {values: [0.4, 0.5]}
repeats: 2
"""
RUNS = """run,variant,point,repeat,particles.porosity,state,reason,peak_stress_Pa,strain_at_peak,drops
p0r0,paper,0,0,0.4,done,,3000000.0,0.15,2
p0r1,paper,0,1,0.4,done,,3400000.0,0.16,4
p1r0,paper,1,0,0.5,done,,1500000.0,0.14,1
p1r1,paper,1,1,0.5,failed,"energy came from <b>nowhere</b>, at step 5",,,
"""
STATISTICS = """variant,point,particles.porosity,measure,mean,deviation,runs,low,high
paper,0,0.4,peak_stress_Pa,3200000,282842.7,2,1,2
paper,0,0.4,strain_at_peak,0.155,0.00707,2,1,2
paper,0,0.4,drops,3,1.414,2,1,2
paper,1,0.5,peak_stress_Pa,1500000,0,1,-inf,inf
paper,1,0.5,strain_at_peak,0.14,0,1,-inf,inf
"""
ENSEMBLE = """variant,measure,grains,mean,mean_low,mean_high,\
deviation,deviation_low,deviation_high,weibull_modulus,weibull_scale
paper,peak_force_N,40,14.81,13.5,16.12,4.2,3.35,5.05,3.912,16.3
paper,work_J_per_m3,40,52000,51000,53000,0,0,0,nan,nan
"""
VERDICTS = """says,source,variant,verdict,evidence
the stress falls with porosity,"Fig. 10 & 11",paper,reproduced,"rank correlation -1"
drops are the same,,paper,not reproduced,p = 0.01
something else,,paper,not decidable,fewer than two points
"""


def report(*arguments: object) -> Result:
    return CliRunner().invoke(main, ["report", *map(str, arguments)])


@pytest.fixture
def sweep(tmp_path: Path) -> Path:
    folder = tmp_path / "sweep"
    for name in ("p0r0", "p0r1", "p1r0"):
        (folder / "runs" / name).mkdir(parents=True)
    for name, text in (("study.yaml", STUDY), ("runs.csv", RUNS), ("statistics.csv", STATISTICS)):
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "verdicts.csv").write_text(VERDICTS, encoding="utf-8")
    for name in ("curves.png", "measures.png"):
        (folder / name).write_bytes(b"\x89PNG picture")
    return folder


def test_points_have_mean_and_deviation(sweep: Path) -> None:
    assert report(sweep).output == f"{sweep / 'report.html'}\n"
    page = Page(sweep / "report.html")
    heads = ["particles.porosity", "runs", "peak stress [MPa]", "strain at peak [%]"]
    assert heads in [row[1:] for row in page.cells]
    assert ["paper", "0.4", "2", "3.20 ± 0.28", "15.50 ± 0.71"] in page.cells
    assert ["paper", "0.5", "1", "1.5", "14"] in page.cells
    assert ["paper", "0.4", "2", "3.0 ± 1.4"] in page.cells  # folded: drops


def test_runs_that_ended_before_their_peak_are_counted(sweep: Path) -> None:
    table = sweep / "runs.csv"
    lines = [
        f"{line},{inside}" for line, inside in zip(RUNS.splitlines(), ("peak_inside", 1.0, 0.0, 1.0, ""), strict=True)
    ]
    table.write_text("\n".join(lines) + "\n", encoding="utf-8")
    report(sweep)
    assert "1 of 3 runs ended before their stress had fallen by a fifth" in Page(sweep / "report.html").text
    table.write_text(RUNS, encoding="utf-8")
    report(sweep)
    assert "ended before" not in Page(sweep / "report.html").text


def test_the_study_its_runs_and_its_plots_are_shown(sweep: Path) -> None:
    report(sweep)
    page = Page(sweep / "report.html")
    for told in (
        "porosity <i>",
        "What the porosity does",
        "1 of 4 runs are not done",
        "vary.particles.porosity.values",
    ):
        assert told in page.text
    assert "p1r1: failed, energy came from <b>nowhere</b>, at step 5" in page.text
    assert page.rows["p0r1"] == ["paper", "0.4", "1", "done"]
    assert {"runs/p0r0/", "runs/p0r1/", "runs/p1r0/"} <= set(page.loaded)
    assert "runs/p1r1/" not in page.loaded
    assert page.loaded.count("data:image/png;base64,iVBORyBwaWN0dXJl") == 2
    assert page.foreign == []
    assert not {"i", "b", "script", "link"} & set(page.tags)


def test_what_a_sweep_really_writes_can_be_read(tmp_path: Path) -> None:
    write(tmp_path, COLLISION)
    study = "study: bounce\nbase: scene.yaml\nvary: {contacts.pairs.default.restitution: [0.5, 0.9]}\n"
    study += "expect: [{says: it takes as long, check: same, measure: steps}]\n"
    done = CliRunner().invoke(main, ["sweep", str(write(tmp_path, study, "bounce.yaml")), "-o", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    assert report(tmp_path / "out").exit_code == 0
    page = Page(tmp_path / "out" / "report.html")
    assert "bounce" in page.text
    assert ["0.9", "1", "2"] in [row[:3] for row in page.cells]
    assert ["contacts.pairs.default.restitution", "repeat", "state"] in [row[1:] for row in page.cells]
    assert page.rows["it takes as long"][1] == "reproduced"


def test_an_ensemble_has_intervals_and_a_weibull_modulus(sweep: Path) -> None:
    (sweep / "ensemble.csv").write_text(ENSEMBLE, encoding="utf-8")
    (sweep / "weibull.png").write_bytes(b"\x89PNG picture")
    report(sweep)
    page = Page(sweep / "report.html")
    heads = ["variant", "measure", "grains", "mean [95 % interval]", "deviation [95 % interval]", "Weibull modulus"]
    assert heads in page.cells
    assert ["paper", "peak force [N]", "40", "14.8 [13.5, 16.1]", "4.20 [3.35, 5.05]", "3.912"] in page.cells
    assert ["paper", "work [kJ/m³]", "40", "52.0 [51.0, 53.0]", "0", ""] in page.cells
    assert page.loaded.count("data:image/png;base64,iVBORyBwaWN0dXJl") == 3


def test_a_sweep_of_few_grains_has_no_ensemble(sweep: Path) -> None:
    report(sweep)
    assert "ensemble" not in Page(sweep / "report.html").ids


def test_verdicts_have_colours(sweep: Path) -> None:
    report(sweep)
    page = Page(sweep / "report.html")
    assert page.rows["the stress falls with porosity (Fig. 10 & 11)"] == ["paper", "reproduced", "rank correlation -1"]
    for kind, verdict in (("good", "reproduced"), ("bad", "not reproduced"), ("doubt", "not decidable")):
        assert f'<td class="{kind}">{verdict}</td>' in page.source


def test_a_sweep_without_statistics_verdicts_and_plots_is_shown(sweep: Path) -> None:
    for name in ("statistics.csv", "verdicts.csv", "curves.png", "measures.png"):
        (sweep / name).unlink()
    assert report(sweep).exit_code == 0
    page = Page(sweep / "report.html")
    assert "No run has measured anything yet." in page.text
    assert "Verdicts" not in page.text


def test_a_run_of_a_sweep_has_a_report_like_any_other(sweep: Path) -> None:
    write_run(sweep / "runs" / "p0r0", small_grain())
    assert report(sweep / "runs" / "p0r0").exit_code == 0


def test_a_sweep_comes_alone(sweep: Path) -> None:
    result = report(sweep, sweep / "runs" / "p0r0")
    assert result.exit_code == 2
    assert "give its folder alone" in result.stderr


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("runs.csv", None, "`clast sweep` writes it when its runs have ended"),
        ("runs.csv", b"run,state\n", "it has no column variant, point, repeat, reason"),
        ("statistics.csv", b"\xff\xfe", "cannot be read"),
        ("ensemble.csv", b"variant,measure\n", "it has no column grains, mean"),
        ("study.yaml", b"a: [", "study.yaml: cannot be read"),
    ],
)
def test_a_broken_table_is_one_message(sweep: Path, name: str, content: bytes | None, told: str) -> None:
    (sweep / name).unlink(missing_ok=True)
    if content is not None:
        (sweep / name).write_bytes(content)
    result = report(sweep)
    assert result.exit_code == 2
    assert told in result.stderr
    assert result.stderr.count("\n") == 1
