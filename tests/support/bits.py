"""Compiled code against plain Python: the same function, the same numbers, compared bit by bit."""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any

import numba
import numpy as np

from clast.engine.assemble import let_compiled_code_call


def assert_same_bits(
    sweep: Callable[..., None], functions: list[Callable[..., Any]], count: int, width: int, *arguments: Any
) -> None:
    """Run ``sweep(*arguments, output)`` in plain Python and compiled as the step loop is, and compare every bit.

    Parameters
    ----------
    sweep : function
        Fills a (count, width) float64 table.
    functions : list of functions
        What it calls of the parts under test.
    """
    assert isinstance(sweep, FunctionType)
    plain, compiled = np.full((count, width), np.nan), np.full((count, width), np.nan)
    sweep(*arguments, plain)
    let_compiled_code_call(functions)
    numba.njit(error_model="numpy")(sweep)(*arguments, compiled)
    assert np.isfinite(plain).all()
    different = plain.view(np.uint64) != compiled.view(np.uint64)
    assert not different.any(), f"rows {np.nonzero(different.any(axis=1))[0][:5]}: {plain[different][:5]}"


def random_rotations(draw: np.random.Generator, count: int) -> np.ndarray:
    """Return unit quaternions, (count, 4) float64."""
    q = draw.normal(size=(count, 4))
    return q / np.linalg.norm(q, axis=1)[:, None]


def random_directions(draw: np.random.Generator, count: int) -> np.ndarray:
    """Return unit vectors, (count, 3) float64."""
    n = draw.normal(size=(count, 3))
    return n / np.linalg.norm(n, axis=1)[:, None]
