"""Writing: the files that show a run, made by a process of its own.

What draws needs more memory than a run and may crash: neither becomes the run's.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from types import FrameType
from typing import Any, NoReturn

from clast.parts.writer import NOT_WRITTEN, Written
from clast.results.watch import RunInterruptedError, signals_to
from clast.writing.process import SET


def write(
    folder: Path, names: Sequence[str], starts: Callable[[str], Any], overrides: Sequence[str] = ()
) -> dict[str, Written]:
    """Let writers write the files of a finished run.

    Parameters
    ----------
    folder : Path
        The run folder.
    names : sequence of str
        The writers, in order. One that the scene does not name has its default parameters.
    starts : callable
        Called with the name of each writer when it starts.
    overrides : sequence of str
        ``key.path=value`` each, laid over the scene that the folder keeps.

    Returns
    -------
    dict of str to Written
        By name: the file, or why there is none.

    Raises
    ------
    RunInterruptedError
        After Ctrl-C or SIGTERM; files that were finished stay, of the others nothing is left.
    """
    written: dict[str, Written] = {}
    try:
        with signals_to(_stop):
            while left := [name for name in names if name not in written]:
                with TemporaryDirectory(prefix=".writing-", dir=folder, ignore_cleanup_errors=True) as drafts:
                    written |= _one_process(folder, Path(drafts), left, starts, overrides)
    except OSError as error:  # no room for drafts, or for one more process
        written = {name: Written(None, f"{NOT_WRITTEN}{error}") for name in names} | written
    return written


def _stop(number: int, frame: FrameType | None) -> NoReturn:
    raise RunInterruptedError(number, "the results are kept; 'clast write' makes the files that are missing")


def _one_process(
    folder: Path, drafts: Path, names: Sequence[str], starts: Callable[[str], Any], overrides: Sequence[str]
) -> dict[str, Written]:
    """Let one process write; return what each writer left that ended, and of which one the process died."""
    written: dict[str, Written] = {}
    lost = list(names)
    with _drawing([str(folder), str(drafts), *names, *(f"{SET}{each}" for each in overrides)]) as process:
        for line in process.stdout or ():
            name, *ending = json.loads(line)
            if ending:
                path, skipped = ending
                written[name] = Written(Path(path) if path else None, skipped)
                lost = []
            else:
                starts(name)
                lost = [name]
        reason = f"{NOT_WRITTEN}the process that draws ended with {_end(process.wait())}"
    return written | {name: Written(None, reason) for name in lost}


@contextmanager
def _drawing(given: Sequence[str]) -> Iterator[subprocess.Popen[str]]:
    """Start :mod:`clast.writing.process`; end it with all it started when something comes between.

    It finds modules where this process does, and hears no Ctrl-C of its own: a session apart gets none.
    """
    command = [sys.executable, "-P", "-m", "clast.writing.process", *given]
    around = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, env=around, start_new_session=True
    ) as process:
        try:
            yield process
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)


def _end(code: int) -> str:
    """Tell how a process ended.

    >>> _end(3), _end(-11), _end(-9)
    ('exit code 3', 'signal 11 (SIGSEGV)', 'signal 9 (SIGKILL), as it does when memory runs out')
    """
    if code >= 0:
        return f"exit code {code}"
    hint = ", as it does when memory runs out" if code == -signal.SIGKILL else ""
    return f"signal {-code} ({signal.Signals(-code).name}){hint}"
