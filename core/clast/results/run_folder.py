"""Run folder: which folders a run may be written into, by one run at a time."""

from __future__ import annotations

import errno
import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from clast.errors import RefusedError, RunError
from clast.results import checkpoint, curves, summary
from clast.results.reading import CONFIG_FILE, RESULTS_FILE, open_results

FULL = (errno.ENOSPC, errno.EDQUOT)
"""What a disk says that has no room: another folder name is no remedy, so the input is not what is wrong."""


@contextmanager
def run_folder(folder: Path, resume: bool) -> Iterator[bool]:
    """Make the folder of a run and keep other runs out of it; yield whether there is a run in it to go on with.

    A run that ended before its first checkpoint has nothing to go on with or to lose: it is begun anew, and a folder
    that was made for it is removed again.

    Raises
    ------
    RunError
        If the folder cannot be written, another run writes it, it holds a run already or something else, or none to
        resume.
    """
    made = not folder.exists()
    if resume and not (folder / RESULTS_FILE).exists():
        raise RefusedError(f"{folder}: no run to resume here; name its folder with -o, or run without --resume")
    _make(folder)
    try:
        with locked(folder):
            yield _goes_on(folder, resume)
    finally:
        if made and not checkpoint.exists(folder):
            with suppress(OSError):
                for name in (RESULTS_FILE, CONFIG_FILE):
                    (folder / name).unlink(missing_ok=True)
                folder.rmdir()  # only when nothing else was written


def _goes_on(folder: Path, resume: bool) -> bool:
    if not (folder / RESULTS_FILE).exists():
        _refuse_foreign(folder)
        return False
    if not checkpoint.exists(folder):
        _refuse_results_without_checkpoint(folder)
        return False
    if not resume:
        raise RefusedError(
            f"{folder}: holds a run already; add --resume to go on with it, or choose another folder with -o"
        )
    return True


def _make(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise RefusedError(f"{folder}: is a file, and the folder of the run is needed; choose another with -o")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / ".probe"
        probe.touch()
        probe.unlink()
    except OSError as error:
        kind = RunError if error.errno in FULL else RefusedError
        raise kind(f"{folder}: cannot be written ({error.strerror}); choose another folder with -o") from error


@contextmanager
def locked(folder: Path, what: str = "run") -> Iterator[None]:
    """Lock a folder; where its file system knows no locks, do without.

    Raises
    ------
    RunError
        If another one holds it.
    """
    handle = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise RefusedError(
                f"{folder}: another {what} is writing into it; wait until it has ended, "
                "or choose another folder with -o"
            ) from error
        except OSError:
            pass
        yield
    finally:
        os.close(handle)


def _refuse_results_without_checkpoint(folder: Path) -> None:
    if any((folder / name).exists() for name in (curves.FILE, summary.FILE)) or _has_rows(folder):
        raise RefusedError(
            f"{folder}: holds results but no checkpoint, so the run in it cannot go on, and is not overwritten either; "
            "choose another folder with -o, or delete this one"
        )


def _has_rows(folder: Path) -> bool:
    """Tell whether results hold more than the start; what cannot be read may."""
    try:
        with open_results(folder) as file:
            return "curves/time_s" in file and len(file["curves/time_s"]) > 1
    except (RunError, OSError, RuntimeError, KeyError, ValueError):
        return True


def _refuse_foreign(folder: Path) -> None:
    """Refuse a folder that holds anything but a run; hidden files do not count, nor empty ones: a log just opened.

    Raises
    ------
    RunError
        With the name of something in it.
    """
    held = sorted(each.name for each in folder.iterdir() if not (each.name.startswith(".") or _is_empty_file(each)))
    if held:
        more = f" and {len(held) - 1} more" if len(held) > 1 else ""
        raise RefusedError(
            f"{folder}: is not empty and not the folder of a run, it holds {held[0]}{more}; choose another with -o"
        )


def _is_empty_file(path: Path) -> bool:
    return path.is_file() and path.stat().st_size == 0
