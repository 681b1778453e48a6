"""Readable: in which words and units a measure is shown; tables and files keep SI."""

from __future__ import annotations

from typing import NamedTuple

UNITS = (("_J_per_m3", "kJ/m³", 1e-3), ("_Pa", "MPa", 1e-6), ("_N", "N", 1.0), ("_s", "s", 1.0))
SHARES = ("strain_at_peak", "largest_drop", "broken_at_peak", "broken_at_end")


class Readable(NamedTuple):
    """How a measure is shown: in words, its unit (empty for plain numbers), and the factor from SI."""

    words: str
    unit: str
    factor: float


def readable(name: str) -> Readable:
    """Return how a measure is shown, by the unit at the end of its name.

    >>> readable("slope_5_15_Pa"), readable("largest_drop")
    (Readable(words='slope 5 15', unit='MPa', factor=1e-06), Readable(words='largest drop', unit='%', factor=100.0))
    """
    if name in SHARES:
        return Readable(name.replace("_", " "), "%", 100.0)
    for end, unit, factor in UNITS:
        if name.endswith(end):
            return Readable(name.removesuffix(end).replace("_", " "), unit, factor)
    return Readable(name.replace("_", " "), "", 1.0)
