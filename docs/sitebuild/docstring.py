"""The docstring of a part as Markdown: its sentences, and its sections with their headings."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

from sitebuild.doctests import fenced

_HEADING = re.compile(r"^(\S.*)\n-{3,}$", re.MULTILINE)
_DOI = re.compile(r"doi:(10\.\S*[^\s.,;:])")
_CODE = re.compile(r"(```.*?```|``.*?``|`.*?`)", re.DOTALL)


class Section(NamedTuple):
    """One section of a docstring; the sentences before the first have no title."""

    title: str
    text: str


def sections(documented: object) -> list[Section]:
    """Return the sections of what has a docstring, in their order.

    >>> class Spring:
    ...     '''A spring.
    ...
    ...     Equation
    ...     --------
    ...     F = k x
    ...     '''
    >>> sections(Spring)
    [Section(title='', text='A spring.'), Section(title='Equation', text='F = k x')]
    """
    text = inspect.getdoc(documented) or ""
    found = list(_HEADING.finditer(text))
    starts = [(0, 0, ""), *((each.start(), each.end(), each[1]) for each in found), (len(text), 0, "")]
    return [Section(title, text[begin:end].strip("\n")) for (_, begin, title), (end, _, _) in pairwise(starts)]


def markdown(section: Section) -> str:
    """Return a section with its heading."""
    body = _BODIES.get(section.title, plain)(section.text)
    return f"## {section.title}\n\n{body}" if section.title else body


def plain(text: str) -> str:
    r"""Return text in which stars and angles stand for themselves, outside of code, and DOIs are links.

    >>> plain("E* of ``a*b`` < 1")
    'E\\* of ``a*b`` &lt; 1'
    """
    pieces = _CODE.split(fenced(text))
    pieces[::2] = [_prose(piece) for piece in pieces[::2]]
    return "".join(pieces)


def _prose(text: str) -> str:
    return _DOI.sub(r"[doi:\1](<https://doi.org/\1>)", text.replace("*", "\\*").replace("<", "&lt;"))


def _equation(text: str) -> str:
    return f"```text\n{text}\n```"


def _symbols(text: str) -> str:
    """Return a list of symbols; a line that goes on is indented."""
    items = re.sub(r"\n[ ]+", " ", text).splitlines()
    split = [item.partition(" : ") for item in items if item.strip()]
    return "\n".join(
        f"- {plain(name)}: {plain(meaning)}" if meaning else f"- {plain(name)}" for name, _, meaning in split
    )


_BODIES: dict[str, Callable[[str], str]] = {"Equation": _equation, "Symbols": _symbols}
