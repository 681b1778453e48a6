"""The nearest name, for messages about names that do not exist."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches


def nearest_name(name: str, known: Iterable[str]) -> str | None:
    """Name most like ``name``, or None where none is like it.

    >>> nearest_name("porosty", ["porosity", "height"])
    'porosity'
    """
    found = get_close_matches(name, list(known), n=1, cutoff=0.6)
    return found[0] if found else None


def suggestion(name: str, known: Iterable[str]) -> str:
    """Second half of a message: the nearest name, or else all there are.

    >>> suggestion("porosty", ["porosity", "height"])
    "did you mean 'porosity'?"
    >>> suggestion("colour", ["porosity", "height"])
    'known are height, porosity'
    >>> suggestion("colour", [])
    'there are none'
    """
    names = sorted(known)
    if not names:
        return "there are none"
    near = nearest_name(name, names)
    return f"did you mean {near!r}?" if near else f"known are {', '.join(names)}"
