"""Writers work in a process of their own: none can hide the results, whatever it raises, and however it ends."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner

from clast import Simulation, load, run_scene
from clast.cli import main
from clast.parts.writer import Written
from clast.session import Listener
from clast.writing import launch
from tests.scenes import COLLISION, write

INK = '''
import os, signal, sys, time
from pathlib import Path
from typing import Annotated

from pydantic import Field

from clast import hookimpl
from clast.parts.params import Params
from clast.parts.writer import Writer, Written

CLAST_API = 1


class Ink(Params):
    """Parameters of the writers here."""

    colour: Annotated[str, Field(description="What is written")] = "black"


def words(run, params, path):
    print("this must not be taken for news")
    path.with_name("words.index").write_text("1")
    path.write_text(f"{params.colour} {run.n_frames} numba={'numba' in sys.modules}")


def torn(run, params, path):
    path.write_text("half")
    raise ValueError("no ink")


def dead(run, params, path):
    path.write_text("half")
    os.kill(os.getpid(), signal.SIGSEGV)


def slow(run, params, path):
    path.write_text("half")
    (run.folder / "pid.part").write_text(str(os.getpid()))
    (run.folder / "pid.part").rename(run.folder / "pid")
    time.sleep(600)


def silent(run, params, path):
    pass


def leaving(run, params, path):
    sys.exit(0)


def unwilling(run, params, path):
    return Written(None, "nothing to tell")


@hookimpl
def clast_register(registry):
    for write in (words, torn, dead, slow, silent, leaving, unwilling):
        registry.writer(write.__name__, Writer("ink", Ink, f"{write.__name__}.txt", write, needs_frames=False))
'''

CLAST = [sys.executable, "-c", "from clast.cli import main; main()"]


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write two spheres that meet head-on, and a file with writers."""
    folder = tmp_path_factory.mktemp("scene")
    write(folder, INK, "ink.py")
    return write(
        folder, COLLISION.replace("writers: []", "writers: [{type: words, colour: blue}]") + "plugins: [ink.py]"
    )


@pytest.fixture
def folder(scene: Path, tmp_path: Path) -> Path:
    """Run them."""
    return run_scene(load(scene), tmp_path / "run").folder


def nothing(name: str) -> None:
    """Hear nothing."""


def left_over(folder: Path) -> list[str]:
    """Name what a writer that ended badly might leave behind."""
    return [file.name for file in folder.iterdir() if file.name.startswith(".") or "half" in file.read_text("latin-1")]


def wait_until(done: Callable[[], bool]) -> None:
    """Wait for another process."""
    deadline = time.monotonic() + 60
    while not done():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def is_alive(pid: int) -> bool:
    """Tell whether a process has not ended."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_a_run_ends_with_the_file_of_a_writer_from_a_plugin_file(folder: Path) -> None:
    assert (folder / "words.txt").read_text() == "blue 5 numba=False"


def test_what_lies_beside_the_file_is_kept_too_and_nothing_else(folder: Path) -> None:
    assert (folder / "words.index").read_text() == "1"
    assert not left_over(folder)


def test_drawing_leaves_the_process_of_the_run_alone(folder: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from clast.writing import launch\n"
        "written = launch.write(Path(sys.argv[1]), ['vtk', 'figure'], print)\n"
        "print(*written, 'matplotlib' in sys.modules)"
    )
    told = subprocess.run([sys.executable, "-c", code, str(folder)], capture_output=True, text=True, check=True)
    assert told.stdout.split() == ["vtk", "figure", "vtk", "figure", "False"]
    assert (folder / "particles.vtkhdf").exists()


def test_failing_crashing_and_idle_writers_cost_only_their_own_files(folder: Path) -> None:
    (folder / "torn.txt").write_text("of an earlier day")
    started: list[str] = []
    names = ["torn", "dead", "leaving", "silent", "unwilling", "words"]
    written = launch.write(folder, names, started.append)
    assert started == names == list(written)
    assert written["torn"].skipped.startswith("not written: ")
    assert "ink.py:29: ValueError: no ink" in written["torn"].skipped
    assert written["dead"].skipped == "not written: the process that draws ended with signal 11 (SIGSEGV)"
    assert written["leaving"].skipped == "not written: the process that draws ended with exit code 0"
    assert written["silent"].skipped == "not written: the writer left no file silent.txt"
    assert written["unwilling"] == Written(None, "nothing to tell")
    assert written["words"] == Written(folder / "words.txt")
    assert (folder / "torn.txt").read_text() == "of an earlier day"
    assert not left_over(folder)


def test_a_plugin_that_is_gone_is_named_and_the_run_kept(scene: Path, tmp_path: Path) -> None:
    plugin = write(tmp_path, INK, "vanishing.py")

    class Thief(Listener):
        def started(self, simulation: Simulation) -> None:
            plugin.unlink()

    text = scene.read_text().replace("ink.py", plugin.name)
    outcome = run_scene(load(write(tmp_path, text)), tmp_path / "run", listener=Thief())
    assert outcome.summary["steps"] == 4000
    assert "not written: " in outcome.written["words"].skipped
    assert "vanishing.py" in outcome.written["words"].skipped


def test_no_room_for_drafts_costs_the_files_only(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(launch, "TemporaryDirectory", full)
    written = launch.write(folder, ["words"], nothing)
    assert written["words"].skipped == "not written: [Errno 28] No space left on device"


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_stop_while_writing_ends_the_writer_too_and_keeps_the_run(
    scene: Path, tmp_path: Path, number: int, code: int
) -> None:
    folder = tmp_path / "run"
    command = [*CLAST, "run", str(scene), "-o", str(folder), "--set", "output.writers=[words, slow, torn]"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    wait_until((folder / "pid").exists)
    process.send_signal(number)
    told = process.communicate(timeout=60)[1].splitlines()
    assert process.returncode == code
    advice = "the results are kept; 'clast write' makes the files that are missing"
    assert told[-1] == f"stopped by {signal.Signals(number).name}; {advice}"
    assert (folder / "summary.json").exists()
    assert (folder / "words.txt").exists()
    assert not left_over(folder)
    wait_until(lambda: not is_alive(int((folder / "pid").read_text())))


def test_writers_work_where_python_hears_no_signals(folder: Path) -> None:
    written: dict[str, Written] = {}
    thread = threading.Thread(target=lambda: written.update(launch.write(folder, ["words"], nothing)))
    thread.start()
    thread.join(timeout=60)
    assert written["words"].path == folder / "words.txt"


def test_a_script_without_a_guard_is_run_once_and_finds_its_modules(scene: Path, tmp_path: Path) -> None:
    script = write(
        tmp_path,
        "import sys, clast\nprint('begun')\n"
        "outcome = clast.run_scene(clast.load(sys.argv[1]), sys.argv[2])\nprint(outcome.written['words'].path)\n",
        "script.py",
    )
    write(tmp_path, "COLOUR = 'green'", "inkwell.py")
    other = tmp_path / "elsewhere"
    other.mkdir()
    borrowing = INK.replace('{params.colour}"', '{inkwell.COLOUR}"').replace("import os,", "import inkwell, os,")
    write(other, borrowing, "ink.py")
    command = [sys.executable, script.name, str(write(other, scene.read_text())), "run"]
    told = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert told.stdout.split() == ["begun", "run/words.txt"]


def test_a_resumed_run_is_written_with_its_new_writers(scene: Path, tmp_path: Path) -> None:
    run_scene(load(scene, ["output.writers=[]"]), tmp_path / "run")
    assert not (tmp_path / "run" / "words.txt").exists()
    outcome = run_scene(load(scene), tmp_path / "run", resume=True)
    assert outcome.written["words"].path == tmp_path / "run" / "words.txt"


def test_clast_write_writes_again_what_the_scene_names(folder: Path) -> None:
    (folder / "words.txt").unlink()
    told = CliRunner().invoke(main, ["write", str(folder)])
    assert told.exit_code == 0
    assert told.output == f"writing words\n  {folder / 'words.txt'}\n"
    assert (folder / "words.txt").read_text().startswith("blue")


def test_clast_write_changes_what_writers_draw_for_once(folder: Path) -> None:
    kept = (folder / "config.yaml").read_bytes()
    changed = CliRunner().invoke(main, ["write", str(folder), "words", "--set", "output.writers.0.colour=red"])
    assert changed.exit_code == 0, changed.output
    assert (folder / "words.txt").read_text().startswith("red")
    assert (folder / "config.yaml").read_bytes() == kept
    for wrong, told in (("time.end.steps=9", "the run has ended"), ("output.writers.0.hue=1", "not a known key")):
        refused = CliRunner().invoke(main, ["write", str(folder), "--set", wrong])
        assert refused.exit_code != 0
        assert told in refused.output
    assert (folder / "words.txt").read_text().startswith("red")


def test_clast_write_takes_any_writer_and_tells_of_those_that_fail(folder: Path) -> None:
    told = CliRunner().invoke(main, ["write", str(folder), "vtk", "torn"])
    assert told.exit_code == 1
    assert f"  {folder / 'particles.vtkhdf'}\n" in told.output
    assert "no torn: not written" in told.output


def test_a_run_whose_writer_fails_keeps_its_results_and_ends_with_exit_code_1(scene: Path, tmp_path: Path) -> None:
    folder = tmp_path / "run"
    options = ["--set", "output.writers=[words, torn, unwilling]"]
    told = CliRunner().invoke(main, ["run", str(scene), "-o", str(folder), *options])
    assert told.exit_code == 1
    assert told.stderr.endswith(
        f"{folder}: the results are complete, but what torn should show was not written; the reason stands above. Mend "
        f"it and run `clast write {folder}`\n"
    )
    assert "no torn: not written: " in told.stdout
    assert (folder / "words.txt").exists()


def test_clast_write_says_what_is_wrong_with_a_name_or_a_folder(folder: Path, tmp_path: Path) -> None:
    unknown = CliRunner().invoke(main, ["write", str(folder), "wrods"])
    assert unknown.exit_code == 2
    assert "did you mean 'words'?" in unknown.output
    nowhere = CliRunner().invoke(main, ["write", str(tmp_path / "nowhere")])
    assert nowhere.exit_code == 2
    assert "give the run folder" in nowhere.output


def test_clast_write_without_any_writer_names_them_all(scene: Path, tmp_path: Path) -> None:
    run_scene(load(scene, ["output.writers=[]"]), tmp_path / "run")
    told = CliRunner().invoke(main, ["write", str(tmp_path / "run")])
    assert told.exit_code == 2
    assert "names no writer; name one or several: " in told.output
    assert "picture" in told.output
