"""Claim: one sentence that holds for every part of a kind, and how to try it on one of them."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from clast.about import HOME
from clast.errors import PluginError, one_line

EXAMPLES = 60
TRIED = settings(
    max_examples=EXAMPLES,
    derandomize=True,  # the same draws at every call: a failure is the part's, never the dice's
    database=None,
    deadline=None,
    report_multiple_bugs=False,
    phases=(Phase.explicit, Phase.generate, Phase.shrink),
    suppress_health_check=list(HealthCheck),
)


class BrokenError(AssertionError):
    """A claim does not hold: the message says where, what was found, and what was to be."""


@dataclass(frozen=True)
class Claim:
    """What holds for every part of a kind.

    Attributes
    ----------
    says : str
        The sentence.
    check : () -> None
        Tries it; raises :class:`BrokenError` with the smallest case found where it does not hold.
    """

    says: str
    check: Callable[[], None]
    is_needed: bool = False
    """Whether those after it make no sense where it does not hold."""

    def needed(self) -> Claim:
        """Return the same claim, without which those after it make no sense."""
        return replace(self, is_needed=True)


@dataclass(frozen=True)
class Outcome:
    """What became of a claim: ``problem`` is empty where it holds."""

    says: str
    problem: str = ""

    @property
    def passed(self) -> bool:
        """Whether the claim holds."""
        return not self.problem


def claim(says: str, check: Callable[..., None], *drawn: st.SearchStrategy[Any]) -> Claim:
    """Return a claim about all values that can be drawn, or about none where nothing is."""
    return Claim(says, TRIED(given(*drawn)(check)) if drawn else check)


def try_claims(claims: Sequence[Claim]) -> Iterator[Outcome]:
    """Try claims one by one, whatever becomes of those before, but for those that are needed."""
    for each in claims:
        told = Outcome(each.says, _problem(each))
        yield told
        if each.is_needed and not told.passed:
            return


def _problem(tried: Claim) -> str:
    try:
        tried.check()
    except (BrokenError, PluginError) as broken:
        return str(broken)
    except Exception as error:  # what a part raises is told in its own words
        return f"{place(error)}raised {one_line(error)}"
    return ""


def place(error: BaseException) -> str:
    """Return ``file:line: `` of the innermost line outside Clast that an error passed; empty where it passed none."""
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if _foreign(Path(frame.filename))]
    return f"{frames[-1].filename}:{frames[-1].lineno}: " if frames else ""


def _foreign(file: Path) -> bool:
    return file.is_file() and not file.resolve().is_relative_to(HOME) and "hypothesis" not in file.parts


def must(holds: bool, problem: Callable[[], str] | str) -> None:
    """Raise :class:`BrokenError` unless something holds."""
    if not holds:
        raise BrokenError(problem if isinstance(problem, str) else problem())
