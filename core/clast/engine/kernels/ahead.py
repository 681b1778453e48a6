"""Asking for numbers before they are needed: a scene larger than the cache waits for little else."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

LINE = 8
"""Numbers in a cache line; a row of a particle table."""
FOR_READING, KEPT, DATA = 0, 3, 1


@intrinsic  # type: ignore[untyped-decorator]
def ask_for(typing: Any, table: Any, place: Any) -> Any:
    """Begin to load the cache line of a table that holds the number at ``place``, counted from its start."""
    return types.void(table, place), _prefetch


def _prefetch(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    table, place = arguments
    byte, number = ir.IntType(8).as_pointer(), ir.IntType(32)
    data = context.make_array(signature.args[0])(context, builder, table).data
    where = builder.bitcast(builder.gep(data, [place]), byte)
    kind = ir.FunctionType(ir.VoidType(), [byte, number, number, number])
    prefetch = builder.module.declare_intrinsic("llvm.prefetch", [byte], kind)
    builder.call(prefetch, [where, number(FOR_READING), number(KEPT), number(DATA)])
    return context.get_dummy_value()
