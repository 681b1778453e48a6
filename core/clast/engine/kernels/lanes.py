"""Vectors in the lanes of scratch tables, and in the rows of others."""

from __future__ import annotations

from clast.engine.compiler import inlined
from clast.engine.state import Floats

from .layout import LANES


@inlined
def row(table: Floats, k: int, column: int) -> tuple[float, float, float]:
    """Read three neighbouring columns of a table."""
    return (table[k, column], table[k, column + 1], table[k, column + 2])


@inlined
def vector(scratch: Floats, slot: int, lane: int) -> tuple[float, float, float]:
    """Read three slots of a lane."""
    return (
        scratch[slot * LANES + lane],
        scratch[(slot + 1) * LANES + lane],
        scratch[(slot + 2) * LANES + lane],
    )


@inlined
def put(scratch: Floats, slot: int, lane: int, a: tuple[float, float, float]) -> None:
    """Write three slots of a lane."""
    scratch[slot * LANES + lane] = a[0]
    scratch[(slot + 1) * LANES + lane] = a[1]
    scratch[(slot + 2) * LANES + lane] = a[2]
