"""The process that draws: ``python -m clast.writing.process RUN DRAFTS NAME ... --set=KEY=VALUE ...``.

:mod:`clast.writing.launch` starts it.

On its standard output it tells in lines of JSON what it does: ``[name]`` when a writer starts, ``[name, path, reason]``
when it ends. What writers print themselves goes to standard error.
"""

from __future__ import annotations

import errno
import json
import os
import shutil
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import TextIO

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig, load
from clast.errors import ClastError, RunError, one_line
from clast.parts.writer import NOT_WRITTEN, Written
from clast.results.reading import CONFIG_FILE
from clast.results.run import Run, open_run

SET = "--set="
NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
PROBED = 2**18
"""Bytes that must be free when a writer has ended; more than libraries write at once."""


def main(folder: Path, drafts: Path, names: Sequence[str], overrides: Sequence[str] = ()) -> None:
    """Let the writers write, one after the other, each into the empty folder of drafts.

    Overrides are laid over the scene, as on the command line.
    """
    with _standard_output() as told:

        def tell(*what: str) -> None:
            print(json.dumps(what), file=told, flush=True)

        try:
            writers = chosen_writers(load(folder / CONFIG_FILE, overrides), names)
            run = open_run(folder)
        except ClastError as error:
            for name in names:
                tell(name, "", f"{NOT_WRITTEN}{error}")
            return
        with run:
            for chosen in writers:
                tell(chosen.name)
                written = _write(chosen, run, drafts)
                tell(chosen.name, str(written.path or ""), written.skipped)


def chosen_writers(scene: SceneConfig, names: Sequence[str]) -> list[Chosen]:
    """Return writers by name, with the parameters that the scene gives them, or their defaults.

    Raises
    ------
    ConfigError
        If there is no such writer, or it cannot do without parameters.
    """
    own = {chosen.name for chosen in scene.output.writers}
    more = [name for name in names if name not in own]
    for name in more:
        scene.registry.get("writer", name)  # without a scene's file and line, where it is wrong
    if more:
        scene = scene.changed({"output.writers": [*scene.resolved()["output"]["writers"], *more]})
    known = {chosen.name: chosen for chosen in scene.output.writers}
    return [known[name] for name in names]


def _standard_output() -> TextIO:
    """Return standard output for what is told, and let everything else that prints there go to standard error."""
    told = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    return told


def _write(chosen: Chosen, run: Run, drafts: Path) -> Written:
    part, path = chosen.part, drafts / chosen.part.file
    if part.needs_frames and run.n_frames == 0:
        return Written(None, "the run keeps no frames (output.frames: 0)")
    try:
        result = part.write(run, chosen.params, path)
        if isinstance(result, Written):
            if result.path is None:
                return result
            path = result.path
        _refuse_full_disk(drafts)
        return Written(_kept(path, drafts, run.folder))
    except Exception as error:  # whatever a writer raises costs its own file only
        return Written(None, f"{NOT_WRITTEN}{_told(error, drafts)}")
    finally:
        _clear(drafts)


def _kept(path: Path, drafts: Path, folder: Path) -> Path:
    """Move everything that a writer left among the drafts to its place; return the place of its file."""
    if not path.exists():
        raise RunError(f"the writer left no file {path.name}")
    for draft in drafts.iterdir():
        place = folder / draft.name
        if place.is_dir():
            shutil.rmtree(place)
        os.replace(draft, place)
    return folder / path.relative_to(drafts) if path.is_relative_to(drafts) else path


def _clear(drafts: Path) -> None:
    shutil.rmtree(drafts)
    drafts.mkdir()


def _refuse_full_disk(drafts: Path) -> None:
    """Refuse what was written to a disk that is full now: not every library tells that it wrote half a file."""
    probe = drafts / ".probe"
    try:
        probe.write_bytes(bytes(PROBED))
    finally:
        probe.unlink(missing_ok=True)


def _told(error: Exception, drafts: Path) -> str:
    """Say what went wrong; of a mistake in a writer also where."""
    try:
        if isinstance(error, OSError) and error.errno in NO_ROOM:
            raise error
        _refuse_full_disk(drafts)
    except OSError as full:
        return f"{full.strerror}: make room and write it again"
    if isinstance(error, ClastError | OSError):
        return str(error)
    frame = traceback.extract_tb(error.__traceback__)[-1]
    return f"{frame.filename}:{frame.lineno}: {one_line(error)}"


if __name__ == "__main__":
    given = sys.argv[3:]
    main(
        Path(sys.argv[1]),
        Path(sys.argv[2]),
        [each for each in given if not each.startswith(SET)],
        [each.removeprefix(SET) for each in given if each.startswith(SET)],
    )
