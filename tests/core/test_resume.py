"""A run that was stopped, in whatever way, goes on and ends in the same bytes."""

from __future__ import annotations

import json
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from tests.scenes import CRUSH, write

CLAST = [sys.executable, "-c", "from clast.cli import main; main()"]


def arrays(path: Path) -> dict[str, bytes]:
    """Return the bytes of every dataset of a file."""
    found: dict[str, bytes] = {}
    with h5py.File(path) as file:
        file.visititems(
            lambda name, item: found.update({name: item[...].tobytes()}) if hasattr(item, "shape") else None
        )
    return found


def run(scene: Path, folder: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Run a scene to its end."""
    return subprocess.run(
        [*CLAST, "run", str(scene), "-o", str(folder), *options], capture_output=True, text=True, check=False
    )


def start_and_stop(scene: Path, folder: Path, number: int) -> int:
    """Run a scene, send a signal once bonds have begun to break, and return the exit code."""
    process = subprocess.Popen([*CLAST, "run", str(scene), "-o", str(folder)], stdout=subprocess.DEVNULL)
    deadline = time.monotonic() + 120
    while frames_on_disk(folder) < 4:
        assert process.poll() is None, "the run ended before it could be stopped"
        assert time.monotonic() < deadline
        time.sleep(0.02)
    process.send_signal(number)
    return process.wait()


def notes(folder: Path) -> dict[str, Any]:
    """Return the notes of the last checkpoint."""
    with h5py.File(folder / "checkpoint.h5") as file:
        return dict(json.loads(str(file.attrs["about"]))["notes"])


def noted_seconds(folder: Path) -> float:
    """Return how long the run had taken at the last checkpoint, in s."""
    return float(notes(folder)["seconds"])


def frames_on_disk(folder: Path) -> int:
    """Count the frames that the last checkpoint knows."""
    try:
        return int(notes(folder)["lengths"].get("frames", 0))
    except (OSError, KeyError):
        return 0


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the small grain."""
    return write(tmp_path_factory.mktemp("scene"), CRUSH)


@pytest.fixture(scope="module")
def whole(scene: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Run the small grain without a stop."""
    folder = tmp_path_factory.mktemp("runs") / "whole"
    finished = run(scene, folder)
    assert finished.returncode == 0, finished.stderr
    return folder


def assert_same_bytes(one: Path, other: Path) -> None:
    """Compare results, last checkpoint and curves of two runs."""
    for name in ("results.h5", "checkpoint.h5"):
        a, b = arrays(one / name), arrays(other / name)
        assert a.keys() == b.keys()
        assert [key for key in a if a[key] != b[key]] == []
    assert (one / "curves.csv").read_bytes() == (other / "curves.csv").read_bytes()


def test_the_grain_breaks_so_that_the_comparison_means_something(whole: Path) -> None:
    with h5py.File(whole / "results.h5") as file:
        assert len(file["cracks/bond"]) > 20
        assert np.ptp(file["curves/stress_Pa"][:]) > 0


def test_a_repeated_run_gives_the_same_bytes_for_any_thread_count(scene: Path, whole: Path, tmp_path: Path) -> None:
    assert run(scene, tmp_path / "again", "--threads", "2").returncode == 0
    assert_same_bytes(whole, tmp_path / "again")


@pytest.mark.parametrize(
    ("number", "code"),
    [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -9)],
    ids=["ctrl-c", "sigterm", "kill -9"],
)
def test_a_stopped_run_resumes_to_the_same_bytes(
    scene: Path, whole: Path, tmp_path: Path, number: int, code: int
) -> None:
    folder = tmp_path / "stopped"
    assert start_and_stop(scene, folder, number) == code
    before = noted_seconds(folder)
    resumed = run(scene, folder, "--resume")
    assert resumed.returncode == 0, resumed.stderr
    assert_same_bytes(whole, folder)
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["wall_time_s"] > before > 0.0
    assert summary["steps_per_s"] == summary["steps"] / summary["wall_time_s"]


def test_a_finished_run_goes_on_to_a_later_end_as_if_it_had_never_ended(
    scene: Path, whole: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "longer"
    assert run(scene, folder, "--set", "time.end.strain=0.15").returncode == 0
    resumed = run(scene, folder, "--resume")
    assert resumed.returncode == 0, resumed.stderr
    assert arrays(folder / "checkpoint.h5") == arrays(whole / "checkpoint.h5")
    with h5py.File(folder / "results.h5") as longer, h5py.File(whole / "results.h5") as other:
        strain = longer["curves/strain"][:]
        assert len(strain) == pytest.approx(120, abs=2)  # the spacing that it began with
        assert strain[-1] == other["curves/strain"][-1]
        assert (longer["cracks/bond"][:] == other["cracks/bond"][:]).all()
    assert (
        json.loads((folder / "summary.json").read_text())["steps"]
        == json.loads((whole / "summary.json").read_text())["steps"]
    )


def test_a_run_can_be_ended_where_it_stopped_but_not_before(scene: Path, tmp_path: Path) -> None:
    folder = tmp_path / "shorter"
    assert start_and_stop(scene, folder, signal.SIGINT) == 130
    early = run(scene, folder, "--resume", "--set", "time.end.strain=0.001")
    assert early.returncode == 2
    (step,) = re.findall(
        r"time.end: the run is at step (\d+) already, and would end at step \d+; to end it", early.stderr
    )
    assert f"--set 'time.end={{steps: {step}}}'" in early.stderr
    ended = run(scene, folder, "--resume", "--set", f"time.end={{steps: {step}}}")
    assert ended.returncode == 0, ended.stderr
    assert json.loads((folder / "summary.json").read_text())["steps"] == int(step)
    with h5py.File(folder / "results.h5") as file:
        assert file["frames/step"][-1] == int(step)


def test_another_scene_is_not_resumed(scene: Path, whole: Path) -> None:
    refused = run(scene, whole, "--resume", "--set", "bonds.model.yield_stress=3 MPa")
    assert refused.returncode == 2
    assert "bonds.model.yield_stress: 2000000.0 there, 3000000.0 here" in refused.stderr
    assert "Traceback" not in refused.stderr


def test_parts_that_were_edited_since_are_named_before_anything_is_packed(
    scene: Path, whole: Path, tmp_path: Path
) -> None:
    folder = Path(shutil.copytree(whole, tmp_path / "run"))
    for checkpoint in folder.glob("checkpoint*.h5"):
        with h5py.File(checkpoint, "r+") as file:
            about = json.loads(str(file.attrs["about"]))
            about["parts"]["contact_law.hertz_mindlin"] = {"source": "law.py", "digest": "before it was edited"}
            file.attrs["about"] = json.dumps(about)
    result = run(scene, folder, "--resume")
    assert result.returncode == 2
    assert re.search(
        r"was computed before this changed: contact_law 'hertz_mindlin' \(clast [\d.]+\S*\)\. Going on would",
        result.stderr,
    )
    assert "building the scene" not in result.stderr + result.stdout


def test_a_folder_that_holds_a_run_is_not_overwritten(scene: Path, whole: Path) -> None:
    before = (whole / "results.h5").stat().st_mtime_ns
    refused = run(scene, whole)
    assert refused.returncode == 2
    assert "--resume" in refused.stderr
    assert (whole / "results.h5").stat().st_mtime_ns == before


def test_a_damaged_checkpoint_falls_back_to_the_one_before(scene: Path, tmp_path: Path) -> None:
    folder = tmp_path / "damaged"
    start_and_stop(scene, folder, signal.SIGTERM)
    (folder / "checkpoint.h5").write_bytes(b"not a checkpoint")
    assert run(scene, folder, "--resume").returncode == 0


def test_without_any_good_checkpoint_the_message_says_so(scene: Path, tmp_path: Path) -> None:
    folder = tmp_path / "lost"
    start_and_stop(scene, folder, signal.SIGTERM)
    for name in ("checkpoint.h5", "checkpoint.previous.h5"):
        (folder / name).write_bytes(b"not a checkpoint")
    refused = run(scene, folder, "--resume")
    assert refused.returncode == 2
    assert "cannot be read" in refused.stderr
    assert "Traceback" not in refused.stderr
