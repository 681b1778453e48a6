"""A section of the benchmark: what it measures, how the result is kept, and what the page says of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from clast.bench.peer import Peer
from clast.plugins.registry import Registry


class Effort(Enum):
    """How much is measured: rough numbers in a few minutes, what the page needs, or all sizes."""

    QUICK = "quick"
    USUAL = "usual"
    FULL = "full"


@dataclass(frozen=True)
class Task:
    """What a section needs to know.

    Attributes
    ----------
    effort : Effort
    registry : Registry
        Every part that is installed; the user's files are loaded too.
    files : tuple of Path
        The user's plugin files.
    peer : Peer or None
        An installed peer.
    no_peer : str
        Why there is none.
    folder : Path
        Holds scenes while they are measured.
    """

    effort: Effort
    registry: Registry
    files: tuple[Path, ...]
    peer: Peer | None
    no_peer: str
    folder: Path


@dataclass(frozen=True)
class Section:
    """One part of the page.

    Attributes
    ----------
    name : str
        How the command line and the stored result name it.
    title : str
        What it shows.
    Result : type
        What ``measure`` returns: dataclasses, named tuples, lists and numbers, so that JSON can hold it.
    measure : (task) -> Result
    text : (result, folder for pictures) -> str
        Draws the section's pictures and returns its Markdown, headings included.
    """

    name: str
    title: str
    Result: Any
    measure: Callable[[Task], Any]
    text: Callable[[Any, Path], str]
