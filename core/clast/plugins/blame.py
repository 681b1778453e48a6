"""Blame: which line of a plugin an error comes from."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.metadata import entry_points
from pathlib import Path
from types import CodeType

GROUP = "clast"
OWN_DISTRIBUTION = "clast"
FILE_MODULE = "clast_plugin_file_"
"""What the names of modules begin with that are loaded from files a scene names."""


def line_in(path: Path, error: BaseException) -> str:
    """Return ``:line`` where an error left a file, or where the file is no Python; empty where it was not in it."""
    lines = [error.lineno] if isinstance(error, SyntaxError) else []
    lines += [line for _, code, line in _frames(error) if code.co_filename == str(path)]
    return f":{lines[-1]}" if lines else ""


def plugin_line(error: BaseException) -> str | None:
    """Return ``file:line`` of the innermost line of a plugin that an error passed; None where it passed none.

    Clast's own plugins do not count: an error of theirs is Clast's.
    """
    installed = {
        point.module.split(".")[0]
        for point in entry_points(group=GROUP)
        if point.dist is None or point.dist.name != OWN_DISTRIBUTION
    }
    places = [
        f"{code.co_filename}:{line}"
        for module, code, line in _frames(error)
        if module.startswith(FILE_MODULE) or module.split(".")[0] in installed
    ]
    return places[-1] if places else None


def _frames(error: BaseException) -> Iterator[tuple[str, CodeType, int]]:
    step = error.__traceback__
    while step is not None:
        yield str(step.tb_frame.f_globals.get("__name__", "")), step.tb_frame.f_code, step.tb_lineno
        step = step.tb_next
