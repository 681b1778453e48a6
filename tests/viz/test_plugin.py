"""The writers are registered like any plugin's, and loading them imports nothing heavy."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import clast_viz
from clast.commands import view as view_command
from clast.errors import RunError
from clast.results.whole_file import whole_file


class Registry:
    def __init__(self) -> None:
        self.files: dict[str, str] = {}

    def writer(self, name: str, part: Any) -> None:
        assert part.Params() is not None
        self.files[name] = part.file


def test_all_writers_are_registered() -> None:
    registry: Any = Registry()
    clast_viz.clast_register(registry)
    assert registry.files == {
        "recording": "recording.rrd",
        "vtk": "particles.vtkhdf",
        "figure": "stress_strain.png",
        "energy": "energy.png",
        "picture": "picture.png",
        "grains": "grains",
        "csv": "csv",
        "lammps": "lammps",
    }


def test_loading_the_plugin_imports_nothing_heavy() -> None:
    code = "import sys, clast_viz; print(*{name.split('.')[0] for name in sys.modules})"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"rerun", "vtkmodules", "vtk", "pyvista", "matplotlib", "pyarrow", "h5py", "numba"} & set(loaded)


def test_failed_write_leaves_the_old_file_and_no_draft(tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    path.write_text("old", encoding="utf-8")

    def write() -> None:
        with whole_file(path) as draft:
            draft.write_text("half", encoding="utf-8")
            raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        write()
    assert [file.name for file in tmp_path.iterdir()] == ["picture.png"]
    assert path.read_text(encoding="utf-8") == "old"


def test_view_names_a_missing_folder_and_a_missing_recording(tmp_path: Path) -> None:
    with pytest.raises(RunError, match="no such run folder"):
        view_command.view(tmp_path / "nowhere")
    with pytest.raises(RunError, match=r"holds no recording\.rrd"):
        view_command.view(tmp_path)


def test_view_without_a_screen_says_what_to_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "recording.rrd").touch()
    monkeypatch.setattr(view_command, "_has_screen", lambda: False)
    with pytest.raises(RunError, match=r"no screen; copy .* and run `rerun recording\.rrd` there"):
        view_command.view(tmp_path)


def test_view_listens_on_this_machine_only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "recording.rrd").touch()
    commands: list[list[str]] = []

    def run(command: list[str], **_: Any) -> subprocess.CompletedProcess[str]:
        commands.append(command)
        return subprocess.CompletedProcess(command, 1)

    monkeypatch.setattr(view_command, "_has_screen", lambda: True)
    monkeypatch.setattr(subprocess, "run", run)
    with pytest.raises(RunError, match="viewer ended with code 1"):
        view_command.view(tmp_path)
    assert "--bind 127.0.0.1" in " ".join(commands[0])
