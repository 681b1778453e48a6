"""Run folder: which folders a run may be written into."""

from __future__ import annotations

from pathlib import Path

from clast.errors import RunError
from clast.results.store import FILE as RESULTS_FILE


def refuse_foreign(folder: Path) -> None:
    """Refuse a folder that holds anything but a run; hidden files do not count, nor empty ones: a log just opened.

    Raises
    ------
    RunError
        With the name of something in it.
    """
    if not folder.is_dir() or (folder / RESULTS_FILE).exists():
        return
    held = sorted(each.name for each in folder.iterdir() if not (each.name.startswith(".") or _is_empty_file(each)))
    if held:
        more = f" and {len(held) - 1} more" if len(held) > 1 else ""
        raise RunError(
            f"{folder}: is not empty and not the folder of a run, it holds {held[0]}{more}; choose another with -o"
        )


def _is_empty_file(path: Path) -> bool:
    return path.is_file() and path.stat().st_size == 0
