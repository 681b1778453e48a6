"""Compiled code against plain Python: the same function, the same numbers, compared bit by bit."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from clast.testing.bits import same_bits


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
    same_bits(sweep, functions, (count, width), *arguments)


def random_rotations(draw: np.random.Generator, count: int) -> np.ndarray:
    """Return unit quaternions, (count, 4) float64."""
    q = draw.normal(size=(count, 4))
    return q / np.linalg.norm(q, axis=1)[:, None]


def random_directions(draw: np.random.Generator, count: int) -> np.ndarray:
    """Return unit vectors, (count, 3) float64."""
    n = draw.normal(size=(count, 3))
    return n / np.linalg.norm(n, axis=1)[:, None]
