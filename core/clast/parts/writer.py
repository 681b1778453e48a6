"""Writer: turns the results of a run into something to look at."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from clast.parts.params import Params

if TYPE_CHECKING:
    from clast.results.run import Run


NOT_WRITTEN = "not written: "
"""What the reason begins with where a writer failed."""


@dataclass(frozen=True)
class Written:
    """Outcome of a writer: the file, or the plain sentence that says why there is none."""

    path: Path | None
    skipped: str = ""

    @property
    def failed(self) -> bool:
        """Whether the file could not be written, rather than had nothing to show."""
        return self.skipped.startswith(NOT_WRITTEN)


class Export(NamedTuple):
    """What ``clast export`` makes with a writer.

    Attributes
    ----------
    format : str
        The name that ``--to`` takes.
    everything : mapping
        Parameters with which the writer leaves nothing out, as a user writes them.
    """

    format: str
    everything: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True)
class Writer:
    """The part a plugin registers with ``registry.writer(name, Writer(...))``.

    A writer is a pure function of a run's results, so a resumed run ends in the same files as an uninterrupted
    one, and any run can be exported again later. It runs in a process of its own, so what it raises, or a crash, costs
    its file and nothing else.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``output.writers``.
    needs_frames : bool
        Whether it shows frames, so that it is skipped when a run keeps none.
    file : str
        Name of the file it writes inside the run folder.
    write : (run, params, path) -> Written
        Reads the run, writes ``path``. The path lies in an empty folder: whatever a writer leaves there is moved to the
        run folder when it ends, and thrown away when it fails.
    export : Export, optional
        The format that ``clast export`` offers with this writer.
    """

    summary: str
    Params: type[Params]
    file: str
    write: Callable[[Run, Any, Path], Written]
    needs_frames: bool = True
    export: Export | None = None
