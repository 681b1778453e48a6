"""Errors of laws in the compiler and in compiled code, told with the law's own file and line."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from traceback import walk_tb
from typing import Any, NamedTuple

from clast.about import HOME
from clast.engine.sources import source_files
from clast.errors import PluginError, one_line

STAGE = "Failed in nopython mode pipeline"
"""What numba puts above a reason."""
ADVICE = (
    "Laws may use floats, tuples, NamedTuples, 'if', 'for' over ranges and the functions of math; call the law in "
    "plain Python to see that it is right"
)
PLACE = re.compile(r'File "([^"]+)", line (\d+)|Raised from (.+?) \((\d+)\)')
REASON = re.compile(r"^(No implementation|\w*Error: |Unknown|Use of|The use of|Untyped|Cannot|Can't)")


class Heard(NamedTuple):
    """A function of a law, its first and last line, and what it gave in plain Python."""

    name: str
    first: int
    last: int
    result: str


Laws = Mapping[str, Sequence[Heard]]
"""Files of laws, and what was heard of their functions."""


def law_files(
    functions: Iterable[Callable[..., Any]], heard: Mapping[Callable[..., Any], Any] | None = None
) -> dict[str, list[Heard]]:
    """Return the files of laws and of what they call, without those of Clast's own helpers, with what was heard."""
    files = {file.resolve() for file in source_files(functions)}
    found: dict[str, list[Heard]] = {str(file): [] for file in files if not file.is_relative_to(HOME)}
    for function, value in (heard or {}).items():
        code = function.__code__
        last = max(line for _, _, line in code.co_lines() if line is not None)
        spoken = Heard(function.__name__, code.co_firstlineno, last, repr(value))
        found.get(_resolved(code.co_filename), []).append(spoken)
    return found


@contextmanager
def compiler_errors(laws: Laws) -> Iterator[None]:
    """Turn what numba raises over a law into the law's file and line.

    Numba raises errors of its own where it knows what is wrong, and anything else where a law leads it astray. What the
    disk refuses is no matter of the law.

    Raises
    ------
    PluginError
        Instead of the error, which stays attached as its cause.
    """
    try:
        yield
    except (OSError, MemoryError):
        raise
    except Exception as error:
        places = [*_told(error, laws), *_known(error, laws)]
        where = places[0] if places else _somewhere(laws)
        raise PluginError(f"{where}: cannot be compiled: {_reason(error)}. {_beside(where, laws)}{ADVICE}") from error


@contextmanager
def law_errors(laws: Laws) -> Iterator[None]:
    """Tell what a compiled law raised with its line; Clast's own compiled code raises nothing but for want of memory.

    Raises
    ------
    PluginError
        Instead of the error, which stays attached as its cause.
    """
    try:
        yield
    except MemoryError:
        raise
    except Exception as error:
        lines = [(_resolved(frame.f_code.co_filename), line) for frame, line in walk_tb(error.__traceback__)]
        places = [f"{file}:{line}" for file, line in lines if file in laws]
        where = places[-1] if places else _somewhere(laws)
        raise PluginError(f"{where}: raised {one_line(error)}") from error


def _beside(where: str, laws: Laws) -> str:
    """Return what the function at a place gave in plain Python; empty where that is not known."""
    file, _, line = where.rpartition(":")
    for heard in laws.get(file, ()):
        if line.isdigit() and heard.first <= int(line) <= heard.last:
            return f"In plain Python '{heard.name}' gives {heard.result}. "
    return ""


def _somewhere(laws: Laws) -> str:
    """Return what to say where no line is known."""
    return f"a law of this scene, in {' or '.join(sorted(laws))}"


def _told(error: Exception, laws: Laws) -> list[str]:
    """Return the places in laws that an error tells, the innermost first."""
    found = [(_resolved(a or c), b or d) for a, b, c, d in PLACE.findall(str(error))]
    return [f"{file}:{line}" for file, line in found if file in laws]


def _known(error: Exception, laws: Laws) -> list[str]:
    """Return the places in laws at which the compiler was when it failed, the innermost first."""
    from numba.core.ir import Loc

    frames = [frame for frame, _ in walk_tb(error.__traceback__)]
    held = [value for frame in reversed(frames) for value in frame.f_locals.values()]
    spots = [value if isinstance(value, Loc) else getattr(value, "loc", None) for value in held]
    found = [(_resolved(spot.filename), spot.line) for spot in spots if isinstance(spot, Loc)]
    return [f"{file}:{line}" for file, line in found if file in laws]


def _resolved(file: str) -> str:
    return str(Path(file).resolve())


def _reason(error: Exception) -> str:
    """Return the line of an error that says most: numba tells of what is called behind its caller."""
    from numba.core.errors import NumbaError

    text = str(error) if isinstance(error, NumbaError) else one_line(error)
    text = re.sub(r":\s+>>> ", ": ", text)  # the types of a call that has no implementation
    lines = [line.partition("Raised from")[0].strip(" .:") for line in text.splitlines() if line.strip()]
    pairs = zip([STAGE, *lines], lines, strict=False)
    reasons = [line for before, line in pairs if STAGE not in line and (STAGE in before or REASON.search(line))]
    return reasons[-1] if reasons else type(error).__name__
