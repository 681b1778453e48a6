"""A loop is compiled once, however many processes need it at the same moment, and wherever it can be kept."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from clast import Simulation, load
from clast.commands.run import Lines
from clast.engine.assemble import cache_folder
from clast.engine.entry import alone
from tests.scenes import write

FALL = """
materials: {glass: {density: 2500, young_modulus: 1e9, poisson_ratio: 0.2}}
particles: {type: explicit, material: glass, particles: [{position: [0, 0, 0], radius: 1e-3}]}
body_forces: [{type: gravity, acceleration: [0, 0, -9.81]}]
time: {step: 1e-3, end: {steps: 10}}
"""

TAKE_A_STEP = """
import sys
from clast import Simulation, load

simulation = Simulation(load(sys.argv[1]))
print("ready", flush=True)
sys.stdin.readline()
simulation.advance_to(1)
print(sum(simulation.kernel.advance.function.stats.cache_misses.values()))
"""

HOLD = """
import sys, time
from pathlib import Path
from clast.engine.entry import alone

with alone(Path(sys.argv[1])):
    print("inside", flush=True)
    time.sleep(float(sys.argv[2]))
"""


def start(text: str, *arguments: object, **around: str) -> subprocess.Popen[str]:
    """Start a Python program that is talked to by lines, and hear its first one."""
    process = subprocess.Popen(
        [sys.executable, "-c", text, *map(str, arguments)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, **around},
    )
    assert process.stdout is not None
    assert process.stdout.readline()
    return process


def test_two_processes_that_need_a_loop_at_once_compile_it_once(tmp_path: Path) -> None:
    scene = write(tmp_path, FALL)
    both = [start(TAKE_A_STEP, scene, CLAST_CACHE=str(tmp_path / "loops")) for _ in range(2)]
    for process in both:
        assert process.stdin is not None
        process.stdin.write("go\n")
        process.stdin.flush()
    compiled = [int(process.communicate(timeout=120)[0]) for process in both]
    assert sorted(compiled) == [0, 1]


def test_a_killed_process_does_not_keep_the_lock(tmp_path: Path) -> None:
    lock = tmp_path / "lock"
    holder = start(HOLD, lock, 600)
    waiting = subprocess.Popen([sys.executable, "-c", HOLD, str(lock), "0"], stdout=subprocess.PIPE)
    with pytest.raises(subprocess.TimeoutExpired):
        waiting.wait(timeout=1.0)
    holder.send_signal(signal.SIGKILL)
    assert waiting.communicate(timeout=60)[0] == b"inside\n"
    holder.communicate()


def test_where_no_file_can_be_locked_nobody_waits(tmp_path: Path) -> None:
    entered = []
    with alone(tmp_path / "no such folder" / "lock"):
        entered.append(1)
    with alone(tmp_path):
        entered.append(2)
    assert entered == [1, 2]


def test_a_cache_that_cannot_be_written_is_replaced_by_a_temporary_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("CLAST_CACHE", str(write(tmp_path, FALL) / "loops"))  # below a file, so nobody can make it
    kept = cache_folder()
    assert kept.parent == tmp_path
    told: list[bool] = []  # whether anything was compiled already when it was told
    simulation = Simulation(load(tmp_path / "scene.yaml"), compiling=lambda: told.append(any(kept.rglob("*.nbi"))))
    assert simulation.kernel.fresh
    simulation.advance_to(1)
    assert any(kept.rglob("*.nbi"))
    assert not Simulation(load(tmp_path / "scene.yaml"), compiling=lambda: told.append(True)).kernel.fresh
    assert told == [False]
    assert any(kept.glob("clast_kernel_*"))


def test_a_user_is_told_of_another_cache_and_of_a_compiler_that_takes_long(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("CLAST_CACHE", str(write(tmp_path, FALL) / "loops"))
    monkeypatch.setattr("clast.commands.run.LONG_COMPILING", 0.01)
    with Lines() as lines:
        lines.compiling()
        lines.slow_compiler.join()
    told = capsys.readouterr().out
    assert f"loops cannot be written, so they are kept in {cache_folder()}; CLAST_CACHE names another" in told
    assert "still compiling after" in told


def test_a_scene_that_compiles_soon_says_nothing_of_the_compiler(capsys: pytest.CaptureFixture[str]) -> None:
    with Lines() as lines:
        lines.compiling()
    lines.slow_compiler.join()
    assert "still compiling" not in capsys.readouterr().out


def test_a_temporary_cache_open_to_others_is_not_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("CLAST_CACHE", str(write(tmp_path, FALL) / "loops"))
    kept = cache_folder()
    kept.chmod(0o777)
    assert cache_folder() != kept
