"""Doctests in docstrings, which griffe knows in sections named Examples only, are shown as code wherever they stand."""

from __future__ import annotations

import re
from typing import Any

import griffe

_DOCTEST = re.compile(r"(?:^[ ]*>>> .*\n?)(?:^(?![ ]*$).*\n?)*", re.MULTILINE)


class Doctests(griffe.Extension):
    """Puts fences around doctests before mkdocstrings reads them."""

    def on_instance(self, *, obj: griffe.Object, **kwargs: Any) -> None:
        """Change the docstring of an object that was found."""
        if obj.docstring is not None:
            obj.docstring.value = fenced(obj.docstring.value)


def fenced(docstring: str) -> str:
    """Return a docstring with fences around its doctests."""
    return _DOCTEST.sub(lambda found: f"```pycon\n{found[0].rstrip()}\n```\n", docstring).rstrip("\n")
