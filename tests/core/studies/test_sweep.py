"""Sweeps for real: in parallel, stopped and gone on with, with runs that fail and workers that die."""

from __future__ import annotations

import csv
import os
import shutil
import signal
import subprocess
import sys
import time
from collections import namedtuple
from pathlib import Path
from typing import Any

import h5py
import pytest
from click.testing import CliRunner

from clast.cli import main
from clast.results.run_folder import locked
from clast.studies import conduct as conducting
from tests.core.studies.support import QUICK, study_file
from tests.core.test_resume import assert_same_bytes
from tests.scenes import COLLISION, CRUSH

YIELD = "bonds.model.yield_stress"
CLAST = [sys.executable, "-c", "from clast.cli import main; main()"]
DEADLY = '''
"""A generator that takes its process with it where it is told to."""
CLAST_API = 1
import os
from clast.plugins.hookspec import hookimpl
from clast_plugins.generators.explicit import Explicit, generate
from clast.parts.generator import Generator


class Deadly(Explicit):
    deadly: bool = False


def fall(params, folder):
    if params.deadly:
        os._exit(9)
    return generate(params, folder)


@hookimpl
def clast_register(registry):
    registry.generator("deadly", Generator(summary="x", Params=Deadly, generate=fall))
'''


def sweep(file: Path, folder: Path, *options: str) -> Any:
    """Run a study as a user does."""
    return CliRunner().invoke(main, ["sweep", str(file), "-o", str(folder), "--workers", "2", *options])


def rows(folder: Path) -> list[dict[str, str]]:
    """Return the table of a study."""
    with (folder / "runs.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def test_a_sweep_runs_once_and_tells_all(tmp_path: Path) -> None:
    expect = [{"says": "strength grows", "source": "a book", "check": "grows", "measure": "peak_stress_Pa"}]
    file = study_file(
        tmp_path, set=QUICK, vary={YIELD: ["1 MPa", "2 MPa"]}, repeats=2, grain="per_repeat", expect=expect
    )
    told = sweep(file, tmp_path / "out")
    assert told.exit_code == 0, told.output
    found = rows(tmp_path / "out")
    assert [row["state"] for row in found] == ["done"] * 4
    assert [float(row[YIELD]) for row in found] == [1e6, 1e6, 2e6, 2e6]
    assert float(found[0]["peak_stress_Pa"]) > 0.0
    assert "4 runs: 4 done" in told.output
    assert "strength grows" in (tmp_path / "out" / "verdicts.csv").read_text()
    with h5py.File(tmp_path / "out" / "table.h5") as table:
        assert table["curves/stress_Pa"].shape == (4, 201)
        assert list(table[f"axes/{YIELD}"]) == [1e6, 1e6, 2e6, 2e6]
    assert (tmp_path / "out" / "curves.png").read_bytes().startswith(b"\x89PNG")
    done = {each: each.stat().st_mtime_ns for each in (tmp_path / "out" / "runs").rglob("summary.json")}
    again = sweep(file, tmp_path / "out")
    assert "4 of them done already" in again.output
    assert done == {each: each.stat().st_mtime_ns for each in (tmp_path / "out" / "runs").rglob("summary.json")}


def test_a_run_of_a_sweep_is_the_run_of_its_scene(tmp_path: Path) -> None:
    file = study_file(tmp_path, set=QUICK, vary={YIELD: ["1 MPa"]})
    assert sweep(file, tmp_path / "out", "--prepare").exit_code == 0
    (name,) = (tmp_path / "out" / "tasks.txt").read_text().split()
    alone = CliRunner().invoke(main, ["run", str(tmp_path / f"out/scenes/{name}.yaml"), "-o", str(tmp_path / "alone")])
    assert alone.exit_code == 0
    again = sweep(file, tmp_path / "out")
    assert again.exit_code == 0, again.output
    assert_same_bytes(tmp_path / "alone", tmp_path / "out" / "runs" / name)


def test_runs_of_a_job_array_are_gathered(tmp_path: Path) -> None:
    file = study_file(tmp_path, set=QUICK, vary={YIELD: ["1 MPa", "2 MPa"]})
    told = sweep(file, tmp_path / "out", "--prepare")
    assert "2 scenes" in told.output
    name = (tmp_path / "out" / "tasks.txt").read_text().split()[0]
    CliRunner().invoke(
        main, ["run", str(tmp_path / f"out/scenes/{name}.yaml"), "-o", str(tmp_path / "out/runs" / name)]
    )
    assert sweep(file, tmp_path / "out", "--collect").exit_code == 0
    assert [row["state"] for row in rows(tmp_path / "out")] == ["done", "not run"]


@pytest.mark.parametrize(("made", "told"), [(False, "there is no such folder"), (True, "holds no study")])
def test_a_folder_without_a_study_has_nothing_to_gather(tmp_path: Path, made: bool, told: str) -> None:
    if made:
        (tmp_path / "out").mkdir()
    result = sweep(study_file(tmp_path, vary={YIELD: ["1 MPa"]}), tmp_path / "out", "--collect")
    assert result.exit_code == 2
    assert f"{tmp_path / 'out'}: {told}, so there is nothing to gather" in result.output
    assert (tmp_path / "out").exists() == made
    assert not list((tmp_path / "out").glob("*"))


def test_a_failure_is_forgotten_when_the_run_is_done_after_all(tmp_path: Path) -> None:
    file = study_file(tmp_path, set=QUICK, vary={YIELD: ["1 MPa"]})
    sweep(file, tmp_path / "out", "--prepare")
    (name,) = (tmp_path / "out" / "tasks.txt").read_text().split()
    scene = tmp_path / "out" / "scenes" / f"{name}.yaml"
    text = scene.read_text()
    scene.write_text("nonsense: 1")
    assert sweep(file, tmp_path / "out").exit_code == 1
    assert [row["state"] for row in rows(tmp_path / "out")] == ["failed"]
    scene.write_text(text)
    assert sweep(file, tmp_path / "out").exit_code == 0
    assert sweep(file, tmp_path / "out", "--collect").exit_code == 0


def test_a_failure_that_cannot_be_noted_down_costs_that_note_alone(tmp_path: Path) -> None:
    file = study_file(tmp_path, set=QUICK, vary={"time.step": ["1e-5 s", "1e-7 s"]})
    sweep(file, tmp_path / "out", "--prepare")
    (tmp_path / "out" / "failed").write_text("no folder can be made here")
    told = sweep(file, tmp_path / "out")
    assert told.exit_code == 1, told.output
    assert [row["state"] for row in rows(tmp_path / "out")] == ["failed", "done"]


def test_a_run_that_fails_costs_itself_alone(tmp_path: Path) -> None:
    vary = {"time.step": ["1e-7 s", "1e-5 s"]}  # the second is far above the limit
    file = study_file(tmp_path, set=QUICK, vary=vary)
    told = sweep(file, tmp_path / "out")
    assert told.exit_code == 1, told.output
    first, second = rows(tmp_path / "out")
    assert (first["state"], second["state"]) == ("done", "failed")
    assert "limit" in second["reason"]
    assert "failed: 1e-5_s-" in told.output
    gathered = sweep(file, tmp_path / "out", "--collect")
    assert gathered.exit_code == 1
    assert "failed: 1e-5_s-" in gathered.output
    assert rows(tmp_path / "out") == [first, second]


def test_a_worker_that_dies_costs_its_run_alone(tmp_path: Path) -> None:
    (tmp_path / "deadly.py").write_text(DEADLY)
    scene = COLLISION.replace("type: explicit", "type: deadly").replace(
        "materials:", "plugins: [deadly.py]\nmaterials:", 1
    )
    file = study_file(
        tmp_path, scene, vary={"particles.deadly": [False, True, False], "time.end.time": ["1e-4 s", "2e-4 s"]}
    )
    told = sweep(file, tmp_path / "out")
    assert told.exit_code == 1, told.output
    found = rows(tmp_path / "out")
    assert [row["state"] for row in found] == ["done"] * 2 + ["failed"] * 2 + ["done"] * 2, told.output
    assert "workers died with this run" in found[2]["reason"]
    sweep(file, tmp_path / "out", "--collect")
    assert rows(tmp_path / "out") == found


def wait_for(what: Any, process: subprocess.Popen[str]) -> None:
    """Wait until something is so, while a process lives."""
    deadline = time.monotonic() + 120
    while not what():
        assert process.poll() is None, "the study ended before it could be stopped"
        assert time.monotonic() < deadline
        time.sleep(0.02)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_study_that_is_stopped_goes_on_from_there(tmp_path: Path, number: int) -> None:
    file = study_file(tmp_path, vary={YIELD: ["1 MPa", "2 MPa"]}, set={"time.end.strain": 0.1})
    whole = tmp_path / "whole"
    command = [*CLAST, "sweep", str(file), "-o", str(tmp_path / "out"), "--workers", "2"]
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    runs = tmp_path / "out" / "runs"
    wait_for(lambda: len(list(runs.glob("*/checkpoint.h5"))) == 2, process)
    os.killpg(process.pid, number) if number == signal.SIGINT else process.send_signal(number)
    output, last = process.communicate(timeout=60)
    assert process.returncode == 128 + number
    assert last.splitlines()[-1] == f"stopped by {number.name}; the same command goes on from here"
    assert not (tmp_path / "out" / "stop").exists()
    assert {row["state"] for row in rows(tmp_path / "out")} <= {"stopped", "not run", "done"}, output
    again = sweep(file, tmp_path / "out")
    assert again.exit_code == 0, again.output
    assert sweep(file, whole).exit_code == 0
    for name in (each.name for each in runs.iterdir()):
        assert_same_bytes(whole / "runs" / name, runs / name)


def test_a_killed_study_goes_on_too(tmp_path: Path) -> None:
    file = study_file(tmp_path, vary={YIELD: ["1 MPa", "2 MPa"]}, set={"time.end.strain": 0.1})
    command = [*CLAST, "sweep", str(file), "-o", str(tmp_path / "out"), "--workers", "1"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True)
    wait_for(lambda: list((tmp_path / "out" / "runs").glob("*/checkpoint.h5")), process)
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    again = sweep(file, tmp_path / "out")
    assert again.exit_code == 0, again.output
    assert [row["state"] for row in rows(tmp_path / "out")] == ["done"] * 2


def test_a_full_disk_begins_nothing_more(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    usage = namedtuple("usage", "total used free")
    monkeypatch.setattr(conducting.shutil, "disk_usage", lambda path: usage(1, 1, 0))
    told = sweep(study_file(tmp_path, set=QUICK, vary={YIELD: ["1 MPa"]}), tmp_path / "out")
    assert told.exit_code == 1, told.output
    assert "no more runs are begun" in told.output
    assert [row["state"] for row in rows(tmp_path / "out")] == ["not run"]


def test_a_folder_of_something_else_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "thesis.tex").write_text("x")
    told = sweep(study_file(tmp_path, CRUSH), tmp_path / "out")
    assert (told.exit_code, [each.name for each in (tmp_path / "out").iterdir()]) == (2, ["thesis.tex"])
    assert "holds something else" in told.output


def test_results_that_cannot_be_read_are_told(tmp_path: Path) -> None:
    file = study_file(tmp_path, set=QUICK, vary={YIELD: ["1 MPa", "2 MPa"]})
    sweep(file, tmp_path / "out")
    name = rows(tmp_path / "out")[0]["run"]
    (tmp_path / "out" / "runs" / name / "results.h5").write_bytes(b"nothing")
    told = sweep(file, tmp_path / "out")
    assert told.exit_code == 1, told.output
    assert [row["state"] for row in rows(tmp_path / "out")] == ["failed", "done"]
    shutil.rmtree(tmp_path / "out" / "runs" / name)
    again = sweep(file, tmp_path / "out")
    assert again.exit_code == 0, again.output


def test_a_folder_has_one_study_at_a_time_and_keeps_nothing_of_it_that_no_longer_holds(tmp_path: Path) -> None:
    expect = [{"says": "grows", "check": "grows", "measure": "peak_stress_Pa"}]
    keys = {"set": QUICK, "vary": {YIELD: ["1 MPa"]}}
    assert sweep(study_file(tmp_path, expect=expect, **keys), tmp_path / "out").exit_code == 0
    assert (tmp_path / "out" / "verdicts.csv").exists()
    assert sweep(study_file(tmp_path, **keys), tmp_path / "out").exit_code == 0
    assert not (tmp_path / "out" / "verdicts.csv").exists()
    told = sweep(study_file(tmp_path, study="other", **keys), tmp_path / "out")
    assert "holds the study 'try'; choose another folder for 'other'" in told.output
    with locked(tmp_path / "out"):
        assert "another study is writing into it" in sweep(study_file(tmp_path, **keys), tmp_path / "out").output


def test_workers_end_with_the_process_that_leads(tmp_path: Path) -> None:
    file = study_file(tmp_path, vary={YIELD: ["1 MPa", "2 MPa"]}, set={"time.end.strain": 0.1})
    command = [*CLAST, "sweep", str(file), "-o", str(tmp_path / "out"), "--workers", "1"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True)
    wait_for(lambda: list((tmp_path / "out" / "runs").glob("*/checkpoint.h5")), process)
    process.kill()
    deadline = time.monotonic() + 30
    while True:
        try:
            os.killpg(process.pid, 0)
        except ProcessLookupError:
            break
        assert time.monotonic() < deadline, "workers go on without anyone to hear them"
        process.poll()
        time.sleep(0.2)


def test_a_dask_cluster_does_the_runs(tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    file = study_file(tmp_path, set=QUICK, vary={YIELD: ["1 MPa", "2 MPa"]})
    assert sweep(file, tmp_path / "out", "--executor", "dask").exit_code == 0
    assert sweep(file, tmp_path / "local").exit_code == 0
    for row in rows(tmp_path / "out"):
        assert_same_bytes(tmp_path / "out/runs" / row["run"], tmp_path / "local/runs" / row["run"])


def test_a_scheduler_that_does_not_answer_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("clast.studies.executors.WAIT", "1 s")
    file = study_file(tmp_path, set=QUICK, vary={YIELD: ["1 MPa"]})
    told = sweep(file, tmp_path / "out", "--executor", "dask", "--scheduler", "tcp://127.0.0.1:1")
    assert told.exit_code == 1, told.output
    assert "no Dask scheduler answers at tcp://127.0.0.1:1" in told.output
