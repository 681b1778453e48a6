"""Opened: the runs a report is about, each with its label, also those that cannot be read."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from clast.errors import RunError
from clast.results.reading import CONFIG_FILE, RESULTS_FILE, read_yaml
from clast.results.run import Run, open_run


@dataclass(frozen=True)
class Opened:
    """A run folder as a report sees it.

    Attributes
    ----------
    folder : Path
    label : str
        What tells it from the other runs of the report.
    run : Run or None
        None where its results cannot be read.
    damage : str
        Why they cannot.
    config : dict
        The resolved config; empty where there is none to read.
    """

    folder: Path
    label: str
    run: Run | None
    damage: str
    config: dict[str, Any]


def open_all(folders: Sequence[Path], stack: ExitStack) -> list[Opened]:
    """Open run folders, to be closed with the stack; damaged ones are kept, with what is wrong with them.

    Raises
    ------
    RunError
        If a folder is not there, or not that of a run.
    """
    return [_opened(folder, label, stack) for folder, label in zip(folders, labels(folders), strict=True)]


def _opened(folder: Path, label: str, stack: ExitStack) -> Opened:
    try:
        run = stack.enter_context(open_run(folder))
    except RunError as error:
        if not (folder / RESULTS_FILE).is_file():
            raise
        return Opened(folder, label, None, str(error), _config(folder))
    return Opened(folder, label, run, "", run.config)


def _config(folder: Path) -> dict[str, Any]:
    try:
        return read_yaml(folder / CONFIG_FILE)
    except (RunError, OSError):
        return {}


def labels(folders: Sequence[Path]) -> list[str]:
    """Return the shortest ends of paths that tell folders apart.

    >>> labels([Path("a/run"), Path("b/run")]), labels([Path("a/run"), Path("b/other")])
    (['a/run', 'b/run'], ['run', 'other'])
    """
    parts = [folder.resolve().parts for folder in folders]
    depth = 1
    while depth < max(map(len, parts)) and len({each[-depth:] for each in parts}) < len(set(parts)):
        depth += 1
    return ["/".join(each[-depth:]).replace("//", "/") for each in parts]
