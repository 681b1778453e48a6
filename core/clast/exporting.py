"""Export: a run, or some of its frames, as files for other programs."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from clast.errors import ConfigError, RefusedError
from clast.parts.writer import Export, Writer
from clast.plugins.discovery import discover
from clast.plugins.nearest import suggestion
from clast.plugins.registry import Registry
from clast.results.run import Run, open_run

FOLDER = "export"
"""Folder inside the run's that takes what is exported where nothing else is said."""


def export_run(
    folder: str | Path,
    to: str,
    output: str | Path | None = None,
    frames: str = "all",
    files: Sequence[str | Path] = (),
) -> Path:
    """Write a run in another format, with everything in it; return the file or folder.

    Parameters
    ----------
    folder : path
        A run folder, finished or stopped.
    to : str
        The format: that of any writer which offers one, see :class:`clast.parts.writer.Export`.
    output : path, optional
        The file, which is replaced, or the folder, which must be new or empty; by default ``export/`` in the run
        folder.
    frames : str
        ``all``, ``last``, numbers such as ``0,5,-1``, or a range such as ``0:100:10`` as in Python.
    files : sequence of paths
        Python files with plugins that offer formats.

    Raises
    ------
    ClastError
        If the folder holds no results, no writer offers the format, a frame is not there, the folder is taken, or
        there is nothing to export.
    """
    part, export = format_of(discover(files), to)
    with open_run(folder) as run:
        path = Path(output) if output is not None else run.folder / FOLDER / part.file
        _refuse_taken(path)
        if part.needs_frames and run.n_frames == 0:
            raise RefusedError(
                f"{run.folder}: the run keeps no frames (output.frames: 0), so there is nothing to export"
            )
        path.parent.mkdir(parents=True, exist_ok=True)
        _write(part, export, run.only(chosen_frames(frames, run.n_frames)), path)
    return path


def format_of(registry: Registry, to: str) -> tuple[Writer, Export]:
    """Return the writer that offers a format, and what it offers.

    Raises
    ------
    ConfigError
        There is none; the message names those there are.
    """
    writers: list[Writer] = [registry.get("writer", name).part for name in registry.names("writer")]
    offered = {each.export.format: each for each in writers if each.export is not None}
    found = offered.get(to)
    if found is None or found.export is None:
        failures = "".join(f"\n  {failure}" for failure in registry.failures)
        raise ConfigError(f"--to {to}: there is no such format; {suggestion(to, offered)}{failures}")
    return found, found.export


def chosen_frames(written: str, count: int) -> list[int]:
    """Return the numbers of the frames that a text names.

    Raises
    ------
    ConfigError
        It is neither a word, nor numbers, nor a range; or a run of ``count`` frames has no such frame.

    Examples
    --------
    >>> chosen_frames("0,-1", 5), chosen_frames("1:4:2", 5), chosen_frames("last", 5)
    ([0, 4], [1, 3], [4])
    """
    known = {"all": ":", "last": "-1:"}
    text = known.get(written, written)
    try:
        if ":" in text:
            bounds = [int(each) if each.strip() else None for each in text.split(":")]
            found = list(range(count))[slice(*bounds)]
        else:
            found = [range(count)[int(each)] for each in text.split(",")]
    except IndexError:
        raise ConfigError(f"--frames {written}: the run has {count} frames, 0 to {count - 1}") from None
    except (ValueError, TypeError):
        allowed = "'all', 'last', numbers such as 0,5,-1, or a range such as 0:100:10"
        raise ConfigError(f"--frames {written}: give {allowed}") from None
    if count and not found:
        raise ConfigError(f"--frames {written}: names no frame; the run has {count} frames, 0 to {count - 1}")
    return found


def _refuse_taken(path: Path) -> None:
    if path.is_dir() and any(path.iterdir()):
        raise ConfigError(f"{path}: holds files already; remove them, or name a new folder with -o")


def _write(part: Writer, export: Export, run: Run, path: Path) -> None:
    """Let a writer write beside the place of its file, and move what it leaves there when it is whole."""
    params = part.Params.model_validate(dict(export.everything))
    with TemporaryDirectory(prefix=".exporting-", dir=path.parent) as drafts:
        written = part.write(run, params, Path(drafts) / part.file)
        if written.path is None:
            raise RefusedError(f"{run.folder}: nothing is exported: {written.skipped}")
        if written.path.is_dir() and path.is_file():
            raise ConfigError(f"{path}: is a file, and a folder is needed; name another with -o")
        os.replace(written.path, path)
        for beside in Path(drafts).iterdir():
            os.replace(beside, path.with_name(beside.name))
