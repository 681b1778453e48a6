"""Rows of the particle tables, four or eight numbers at a time.

The compiler does not find such vectors itself: for all it knows the tables could overlap. Every number is computed as
it would be alone, a product and then a sum, so the bits are the same.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from clast.engine.compiler import inlined

from .layout import FIRST, SECOND
from .slots import CHUNKED

COLUMNS, HALF = 8, 4
NUMBER, INDEX, LANE = ir.DoubleType(), ir.IntType(64), ir.IntType(32)
ALIGNMENT = 8


@inlined
def own_ends(sides: int) -> tuple[bool, bool]:
    """Tell which ends of a bond or a pair belong to the chunk that loads them; both, where there is one chunk."""
    if CHUNKED:
        return sides & FIRST != 0, sides & SECOND != 0
    return True, True


@intrinsic  # type: ignore[untyped-decorator]
def add_to_row(typing: Any, table: Any, row: Any, column: Any, vector: Any, wanted: Any) -> Any:
    """Add a vector to three columns of a table, and 0 to the fourth; where it is not wanted do nothing.

    Parameters
    ----------
    table : (n, 8) float64
    row, column : int
        Row, and first column: 0 or 4.
    vector : tuple of 3 floats
    wanted : bool
        The condition is one of single instructions: around a call it would make numba count references to the table.
    """
    return types.void(table, row, column, vector, wanted), partial(_change, ir.IRBuilder.fadd)


@intrinsic  # type: ignore[untyped-decorator]
def take_from_row(typing: Any, table: Any, row: Any, column: Any, vector: Any, wanted: Any) -> Any:
    """Subtract a vector from three columns of a table, and 0 from the fourth; see :func:`add_to_row`."""
    return types.void(table, row, column, vector, wanted), partial(_change, ir.IRBuilder.fsub)


@intrinsic  # type: ignore[untyped-decorator]
def set_half_row(typing: Any, table: Any, row: Any, column: Any, factor: Any, source: Any) -> Any:
    """Set four columns of a table, from ``column`` on, to a factor times those of another."""
    return types.void(table, row, column, factor, source), _set_half


@intrinsic  # type: ignore[untyped-decorator]
def set_row(typing: Any, table: Any, row: Any, base: Any, factor: Any, source: Any) -> Any:
    """Set a row of a table to that of a second plus a factor times that of a third."""
    return types.void(table, row, base, factor, source), partial(_set_sum, COLUMNS)


@intrinsic  # type: ignore[untyped-decorator]
def set_first_half(typing: Any, table: Any, row: Any, base: Any, factor: Any, source: Any) -> Any:
    """Do what :func:`set_row` does, for the first four columns."""
    return types.void(table, row, base, factor, source), partial(_set_sum, HALF)


def _place(context: Any, builder: Any, kind: Any, table: Any, row: Any, column: Any, size: int) -> Any:
    """Return the address of a part of a row, as that of a vector."""
    data = context.make_array(kind)(context, builder, table).data
    row = builder.zext(row, INDEX) if row.type.width < INDEX.width else row
    place = builder.gep(data, [builder.add(builder.mul(row, INDEX(COLUMNS)), column)])
    return builder.bitcast(place, ir.VectorType(NUMBER, size).as_pointer())


def _spread(builder: Any, number: Any, size: int) -> Any:
    """Return a vector that holds the same number everywhere."""
    vector = ir.Constant(ir.VectorType(NUMBER, size), ir.Undefined)
    for k in range(size):
        vector = builder.insert_element(vector, number, LANE(k))
    return vector


def _change(operation: Any, context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    table, row, column, vector, wanted = arguments
    place = _place(context, builder, signature.args[0], table, row, column, HALF)
    change = ir.Constant(ir.VectorType(NUMBER, HALF), [NUMBER(0.0)] * HALF)
    for k in range(3):
        change = builder.insert_element(change, builder.extract_value(vector, k), LANE(k))
    with builder.if_then(builder.trunc(wanted, ir.IntType(1))):
        changed = operation(builder, builder.load(place, align=ALIGNMENT), change)
        builder.store(changed, place, align=ALIGNMENT)
    return context.get_dummy_value()


def _set_half(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    table, row, column, factor, source = arguments
    kinds = signature.args
    numbers = builder.load(_place(context, builder, kinds[4], source, row, column, HALF), align=ALIGNMENT)
    place = _place(context, builder, kinds[0], table, row, column, HALF)
    builder.store(builder.fmul(_spread(builder, factor, HALF), numbers), place, align=ALIGNMENT)
    return context.get_dummy_value()


def _set_sum(size: int, context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    table, row, base, factor, source = arguments
    kinds = signature.args
    start = builder.load(_place(context, builder, kinds[2], base, row, INDEX(0), size), align=ALIGNMENT)
    numbers = builder.load(_place(context, builder, kinds[4], source, row, INDEX(0), size), align=ALIGNMENT)
    place = _place(context, builder, kinds[0], table, row, INDEX(0), size)
    total = builder.fadd(start, builder.fmul(_spread(builder, factor, size), numbers))
    builder.store(total, place, align=ALIGNMENT)
    return context.get_dummy_value()
