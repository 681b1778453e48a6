"""A program that is stopped before its run has begun ends with one line and leaves nothing behind."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from clast import load, run_scene
from clast.results.watch import RunInterruptedError, StopError
from clast.session import Listener
from tests.scenes import COLLISION, write

AT_AN_IMPORT = """
import os, sys
import clast.__main__

module, number = sys.argv.pop(1), int(sys.argv.pop(1))

class Killer:
    def find_spec(self, name, path, target=None):
        if name == module:
            sys.meta_path.remove(self)
            os.kill(os.getpid(), number)

sys.meta_path.insert(0, Killer())
clast.__main__.main()
"""
"""Sends a signal to itself when it is about to import a module."""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("module", ["click", "pydantic", "numba", "h5py"])
def test_a_stop_while_something_is_imported_is_one_line(tmp_path: Path, module: str, number: int) -> None:
    scene = write(tmp_path, COLLISION)
    command = [sys.executable, "-c", AT_AN_IMPORT, module, str(int(number)), "run", str(scene), "-o", "runs/one"]
    told = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert told.returncode == 128 + number
    assert told.stderr.startswith(f"stopped by {signal.Signals(number).name}")
    assert told.stderr.count("\n") == 1
    assert not list((tmp_path / "runs").glob("*"))


def test_a_stop_while_a_run_is_built_that_goes_on_says_that_its_checkpoint_is_there(tmp_path: Path) -> None:
    class Stopping(Listener):
        def building(self) -> None:
            raise StopError(signal.SIGTERM)

    config = load(write(tmp_path, COLLISION))
    with pytest.raises(RunInterruptedError, match="stopped by SIGTERM; nothing was written yet"):
        run_scene(config, tmp_path / "run", listener=Stopping())
    run_scene(config, tmp_path / "run")
    with pytest.raises(RunInterruptedError, match="SIGTERM; the checkpoint is as it was: go on with --resume"):
        run_scene(config, tmp_path / "run", resume=True, listener=Stopping())


def test_a_run_whose_wall_clock_time_is_up_is_left_with_a_checkpoint_and_ends_in_the_same_bytes(tmp_path: Path) -> None:
    scene = load(write(tmp_path, COLLISION), ["output.writers=[]"])
    run_scene(scene, tmp_path / "whole")
    told = (
        r"stopped after 1e-09 s of wall-clock time \(time.wall_time\), at .* s, step \d+ of 4000; go on with --resume"
    )
    with pytest.raises(RunInterruptedError, match=told) as error:
        run_scene(scene.changed({"time.wall_time": 1e-9}), tmp_path / "cut")
    assert error.value.exit_code == 75
    run_scene(scene.changed({"time.wall_time": "1 h"}), tmp_path / "cut", resume=True)
    whole, cut = ((tmp_path / name / "curves.csv").read_bytes() for name in ("whole", "cut"))
    assert whole == cut
