"""Texts of users, without what neither HTML nor SVG can hold."""

from __future__ import annotations


def printable(text: str) -> str:
    r"""Return a text with every character that does not print, but line ends and tabs, replaced by a mark.

    >>> printable("grain\x00 1\n")
    'grain� 1\n'
    """
    return "".join(each if each.isprintable() or each in "\n\t" else "\N{REPLACEMENT CHARACTER}" for each in text)
