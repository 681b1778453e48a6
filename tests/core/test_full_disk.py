"""A disk that takes no more: one sentence, nothing half-written, and a run that goes on to the same bytes."""

from __future__ import annotations

import resource
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest

from clast import open_run
from clast.results import room
from clast.results.room import NoRoomError, room_beyond
from tests.core.test_resume import CLAST, assert_same_bytes, run
from tests.scenes import CRUSH, write

MANY_FRAMES = ("--set", "output.frames=400", "--set", "output.samples=400")


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write the small grain."""
    return write(tmp_path_factory.mktemp("scene"), CRUSH)


@pytest.fixture(scope="module")
def whole(scene: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Run the small grain where there is room."""
    folder = tmp_path_factory.mktemp("runs") / "whole"
    finished = run(scene, folder, *MANY_FRAMES)
    assert finished.returncode == 0, finished.stderr
    return folder


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """Mount a file system of 4 MB."""
    place = tmp_path / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", str(place)]
    try:
        if subprocess.run(mount, capture_output=True, check=False).returncode != 0:
            pytest.skip("only root may mount a file system")
    except FileNotFoundError:
        pytest.skip("there is no mount command")
    yield place
    subprocess.run(["umount", str(place)], check=True)


def run_limited(scene: Path, folder: Path, most: int, *options: str) -> subprocess.CompletedProcess[str]:
    """Run a scene that may write no file of more bytes than ``most``."""
    return subprocess.run(
        [*CLAST, "run", str(scene), "-o", str(folder), *MANY_FRAMES, *options],
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY)),
    )


def refused(finished: subprocess.CompletedProcess[str]) -> str:
    """Return the one line that a run said when the disk refused."""
    assert finished.returncode == 1, finished.stderr
    assert finished.stderr.count("\n") == 1, finished.stderr
    return finished.stderr


def test_a_full_disk_ends_the_run_in_one_sentence_and_resumes_to_the_same_bytes(
    scene: Path, whole: Path, small_disk: Path
) -> None:
    filler = small_disk / "filler"
    filler.write_bytes(bytes(1_100_000))
    folder = small_disk / "run"
    told = refused(run(scene, folder, *MANY_FRAMES))
    assert "cannot be written (No space left on device)" in told
    assert "the last checkpoint is kept: make room and go on with --resume" in told
    with open_run(folder) as left:
        assert not left.complete
        assert left.n_frames > 2
    subprocess.run(["mount", "-o", "remount,size=100m", str(small_disk)], check=True)
    resumed = run(scene, folder, *MANY_FRAMES, "--resume")
    assert resumed.returncode == 0, resumed.stderr
    assert_same_bytes(whole, folder)


@pytest.mark.parametrize("share", [0.8, pytest.param(0.9, marks=pytest.mark.long), 0.999])
def test_wherever_a_file_is_refused_the_run_goes_on_to_the_same_bytes(
    scene: Path, whole: Path, tmp_path: Path, share: float
) -> None:
    folder = tmp_path / "run"
    most = int(share * (whole / "results.h5").stat().st_size)
    told = refused(run_limited(scene, folder, most))
    assert told == (
        f"{folder}/results.h5: cannot be written (File too large); the last checkpoint is kept: make room and go on "
        "with --resume\n"
    )
    with open_run(folder) as left:
        assert not left.complete
    resumed = run(scene, folder, *MANY_FRAMES, "--resume")
    assert resumed.returncode == 0, resumed.stderr
    assert_same_bytes(whole, folder)


@pytest.mark.parametrize("most", [0, *(pytest.param(size, marks=pytest.mark.long) for size in (2000, 20_000)), 100_000])
def test_without_room_for_the_first_checkpoint_the_run_is_simply_started_again(
    scene: Path, whole: Path, tmp_path: Path, most: int
) -> None:
    folder = tmp_path / "run"
    told = refused(run_limited(scene, folder, most))
    assert "the run has no checkpoint yet: make room and start it again" in told
    assert run(scene, folder, *MANY_FRAMES).returncode == 0
    assert_same_bytes(whole, folder)


@pytest.mark.parametrize("lacking", ["posix_fallocate", None])
def test_what_may_not_grow_stays_as_it_was_and_can_be_closed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, lacking: str | None
) -> None:
    if lacking:
        monkeypatch.delattr(room.os, lacking)
    path = tmp_path / "numbers.h5"
    with h5py.File(path, "w") as file:
        file.create_dataset("a", data=np.arange(1000), maxshape=(None,))
    before, limits = path.read_bytes(), resource.getrlimit(resource.RLIMIT_FSIZE)
    file = h5py.File(path, "r+")
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, limits[1]))
    try:
        with pytest.raises(NoRoomError, match="too large"), room_beyond(file, 4_100_000):
            file["a"].resize(500_000, axis=0)
        file.close()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert path.read_bytes() == before
    with h5py.File(path, "r+") as again, room_beyond(again, 4_100_000):
        again["a"].resize(500_000, axis=0)
        again["a"][:] = 7
    assert path.stat().st_size < 4_100_000
    with h5py.File(path) as read:
        assert (read["a"][:] == 7).all()


def test_curves_and_summary_are_there_whole_or_not_at_all(scene: Path, whole: Path, tmp_path: Path) -> None:
    folder = tmp_path / "run"
    assert run(scene, folder, *MANY_FRAMES).returncode == 0
    for name in ("curves.csv", "summary.json"):
        (folder / name).unlink()
    told = refused(run_limited(scene, folder, 1000, "--resume"))
    assert told.startswith(f"{folder}/")
    assert "File too large" in told
    assert not (folder / "curves.csv").exists()
    assert not list(folder.glob(".*unfinished*"))
    assert run(scene, folder, *MANY_FRAMES, "--resume").returncode == 0
    assert_same_bytes(whole, folder)


@pytest.mark.parametrize("writer", ["vtk", "recording"])
def test_a_writer_that_finds_the_disk_full_leaves_no_half_file(
    scene: Path, whole: Path, small_disk: Path, writer: str
) -> None:
    folder = small_disk / "run"
    shutil.copytree(whole, folder, ignore=shutil.ignore_patterns("checkpoint*", "curves.csv"))
    (small_disk / "filler").write_bytes(bytes(800_000))
    command = [*CLAST, "write", str(folder), writer]
    told = subprocess.run(command, capture_output=True, text=True, check=False)
    expected = f"no {writer}: not written: No space left on device: make room and write it again\n"
    assert (told.returncode, told.stderr) == (1, expected)
    assert not [path.name for path in folder.iterdir() if path.suffix in (".vtkhdf", ".rrd")]
    (small_disk / "filler").unlink()
    subprocess.run(["mount", "-o", "remount,size=100m", str(small_disk)], check=True)
    assert subprocess.run(command, capture_output=True, check=False).returncode == 0
