"""What a run says about the folder it is to be written into, and about what it finds there."""

from __future__ import annotations

import errno
import subprocess
import sys
from pathlib import Path

import h5py
import pytest

from clast.errors import RunError
from clast.results.run_folder import run_folder
from tests.core.spoiled import clast, said, scene, table
from tests.scenes import COLLISION

pytestmark = pytest.mark.usefixtures("in_an_empty_folder")


def test_a_folder_with_anything_but_a_run_is_not_written_into() -> None:
    Path("thesis").mkdir()
    table("thesis/chapter.tex", "words")
    table("thesis/notes.txt", "more words")
    told = said(clast("run", scene(), "-o", "thesis"))
    assert told == (
        "thesis: is not empty and not the folder of a run, it holds chapter.tex and 1 more; choose another with -o"
    )
    assert said(clast("run", scene(), "-o", "thesis/chapter.tex/run")).startswith(
        "thesis/chapter.tex/run: cannot be written (Not a directory); choose another folder with -o"
    )
    assert said(clast("run", scene(), "-o", "new", "--resume")).startswith("new: no run to resume here")


def test_a_disk_without_room_for_a_folder_is_no_wrong_input(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "mkdir", full)
    with pytest.raises(RunError, match="run: cannot be written") as refused, run_folder(Path("run"), False):
        pass
    assert refused.value.exit_code == 1


def test_a_run_is_neither_overwritten_nor_gone_on_with_by_another_scene() -> None:
    table("one.yaml", COLLISION)
    Path("run").mkdir()
    Path("run/log").touch()
    assert clast("run", "one.yaml", "-o", "run").exit_code == 0
    assert said(clast("run", "one.yaml", "-o", "run")) == (
        "run: holds a run already; add --resume to go on with it, or choose another folder with -o"
    )
    refused = clast("run", "one.yaml", "-o", "run", "--resume", "--set", "contacts.pairs.default.restitution=0.6")
    assert "building" not in refused.stdout
    assert said(refused).startswith(
        "run/checkpoint.h5: belongs to another scene, so it cannot be resumed (contacts.pairs.default.restitution: 0.5"
    )
    for name in ("checkpoint.h5", "checkpoint.previous.h5"):
        Path("run", name).write_bytes(b"torn")
    told = said(clast("run", "one.yaml", "-o", "run", "--resume"))
    assert told.startswith("run/checkpoint.h5: cannot be read")
    assert len(told.splitlines()) == 1


def spoilt_run(*removed: str) -> None:
    """Make a finished run and take some of its files away."""
    table("one.yaml", COLLISION)
    assert clast("run", "one.yaml", "-o", "run").exit_code == 0
    for name in removed:
        Path("run", name).unlink()


def test_results_that_lost_their_checkpoint_are_not_overwritten() -> None:
    spoilt_run("checkpoint.h5", "checkpoint.previous.h5")
    for options in ([], ["--resume"]):
        assert said(clast("run", "one.yaml", "-o", "run", *options)) == (
            "run: holds results but no checkpoint, so the run in it cannot go on, and is not overwritten either; "
            "choose another folder with -o, or delete this one"
        )


@pytest.mark.parametrize("options", [[], ["--resume"]])
def test_a_run_that_ended_before_its_first_checkpoint_is_begun_anew(options: list[str]) -> None:
    spoilt_run("checkpoint.h5", "checkpoint.previous.h5", "curves.csv", "summary.json")
    with h5py.File("run/results.h5", "r+") as file:
        for data in file["curves"].values():
            data.resize(1, axis=0)
    assert clast("run", "one.yaml", "-o", "run", *options).exit_code == 0
    assert len(Path("run/curves.csv").read_text().splitlines()) == 402


@pytest.mark.parametrize("keep", [0, 3000, 30_000])
def test_a_damaged_results_file_is_one_sentence_in_every_command(keep: int) -> None:
    spoilt_run()
    torn = Path("run/results.h5").read_bytes()[:keep]
    Path("run/results.h5").write_bytes(torn)
    told = said(clast("run", "one.yaml", "-o", "run", "--resume"))
    assert told.startswith("run/results.h5: is damaged, so the run cannot go on (")
    assert told.endswith("); start it anew in another folder with -o")
    assert said(clast("write", "run")).startswith("run/results.h5: cannot be read (")
    assert said(clast("view", "run")).startswith("run: holds no recording.rrd")


def test_results_that_the_checkpoint_has_outgrown_are_told() -> None:
    spoilt_run()
    with h5py.File("run/results.h5", "r+") as file:
        file["curves/time_s"].resize(10, axis=0)
    told = said(clast("run", "one.yaml", "-o", "run", "--resume"))
    assert "is damaged, so the run cannot go on (ValueError: curves has 10 rows, the checkpoint knows 401)" in told


def test_a_checkpoint_that_lacks_something_is_told() -> None:
    spoilt_run("checkpoint.previous.h5")
    with h5py.File("run/checkpoint.h5", "r+") as file:
        del file["particles/pose"]
    told = said(clast("run", "one.yaml", "-o", "run", "--resume"))
    assert told.startswith("run/checkpoint.h5: cannot be read (KeyError: 'particles/pose'): the run cannot go on")


def test_a_file_or_a_reader_in_the_way_of_a_run_is_told() -> None:
    spoilt_run()
    assert said(clast("run", "one.yaml", "-o", "one.yaml")) == (
        "one.yaml: is a file, and the folder of the run is needed; choose another with -o"
    )
    hold = "import h5py, sys; f = h5py.File(sys.argv[1]); print('open', flush=True); sys.stdin.read()"
    command = [sys.executable, "-c", hold, "run/results.h5"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as reader:
        assert reader.stdout is not None
        reader.stdout.readline()
        told = said(clast("run", "one.yaml", "-o", "run", "--resume"))
        reader.communicate()
    assert told == ("run/results.h5: another program has it open, perhaps one that reads it; close that and try again")


@pytest.mark.parametrize("options", [[], ["--resume"]])
def test_two_runs_do_not_write_into_one_folder(options: list[str]) -> None:
    spoilt_run()
    with run_folder(Path("run"), resume=True):
        told = said(clast("run", "one.yaml", "-o", "run", *options))
    assert told == ("run: another run is writing into it; wait until it has ended, or choose another folder with -o")
