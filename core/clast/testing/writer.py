"""What holds for every writer: it reads a run, writes the file that it tells, and says the same again."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

from clast.parts.writer import Writer, Written
from clast.testing.claim import Claim, claim, must

SCENE: dict[str, Any] = {
    "materials": {"glass": {"density": 2500.0, "young_modulus": "1 GPa", "poisson_ratio": 0.2}},
    "particles": {
        "type": "explicit",
        "material": "glass",
        "particles": [
            {"position": [0, 0, 0], "radius": "1 mm", "fixed": True},
            {"position": ["2.2 mm", 0, 0], "radius": "1 mm", "velocity": ["1 m/s", 0, 0]},
        ],
    },
    "time": {"step": "1 us", "end": {"steps": 20}},
    "output": {"frames": 5, "writers": []},
}
"""Two particles, one of which flies away."""


def claims(writer: Writer, params: Any) -> list[Claim]:
    """Return what a writer with parameters must keep to."""
    return [
        claim("it writes the file that it tells, or says why there is none", lambda: _writes(writer, params)),
        claim("it leaves the run as it is", lambda: _harmless(writer, params)),
    ]


def _written(writer: Writer, params: Any, run_folder: Path, out: Path) -> Written:
    from clast import open_run

    with open_run(run_folder) as run:
        return writer.write(run, params, out / writer.file)


def _small_run(folder: Path) -> Path:
    from clast.config.scene import from_mapping
    from clast.session import run_scene

    run_scene(from_mapping(SCENE), folder / "run")
    return folder / "run"


def _writes(writer: Writer, params: Any) -> None:
    must(Path(writer.file).name == writer.file and bool(writer.file), f"'file' is {writer.file!r}; a name is needed")
    with tempfile.TemporaryDirectory() as place:
        (out := Path(place) / "out").mkdir()
        told = _written(writer, params, _small_run(Path(place)), out)
        must(isinstance(told, Written), f"'write' returns {told!r}; a Written is needed")
        if told.path is None:
            must(bool(told.skipped), "'write' makes no file and does not say why")
        else:
            must(told.path.exists(), f"'write' tells of {told.path.name}, which is not there")


def _harmless(writer: Writer, params: Any) -> None:
    with tempfile.TemporaryDirectory() as place:
        (out := Path(place) / "out").mkdir()
        folder = _small_run(Path(place))
        before = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}
        _written(writer, params, folder, out)
        after = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}
        must(before == after, "files of the run have changed")
