"""Compiled code against plain Python: the same function, the same numbers, compared bit by bit."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from clast.testing.claim import must


def same_bits(
    sweep: Callable[..., None], functions: list[Callable[..., Any]], shape: tuple[int, int], *arguments: Any
) -> None:
    """Run ``sweep(*arguments, output)`` in plain Python and compiled as the step loop is, and compare every bit.

    Parameters
    ----------
    sweep : function
        Fills a float64 table, row by row.
    functions : list of functions
        What it calls of the part under test.
    shape : (rows, columns)

    Raises
    ------
    BrokenError
        A number of the table is not finite, or not the same.
    PluginError
        A function cannot be compiled; with its file and line.
    """
    from numba import njit

    from clast.engine.assemble import let_compiled_code_call
    from clast.engine.compiler import STRICT
    from clast.engine.law_errors import compiler_errors, law_files

    plain, compiled = np.full(shape, np.nan), np.full(shape, np.nan)
    sweep(*arguments, plain)
    let_compiled_code_call(functions)
    with compiler_errors(law_files(functions)):
        njit(**STRICT)(sweep)(*arguments, compiled)
    rows = np.nonzero(~np.isfinite(plain).all(axis=1))[0]
    must(len(rows) == 0, lambda: f"row {rows[0]} is not finite: {plain[rows[0]].tolist()}")
    rows = np.nonzero((plain.view(np.uint64) != compiled.view(np.uint64)).any(axis=1))[0]
    must(
        len(rows) == 0,
        lambda: f"row {rows[0]}: plain Python gives {plain[rows[0]].tolist()}, compiled {compiled[rows[0]].tolist()}",
    )
