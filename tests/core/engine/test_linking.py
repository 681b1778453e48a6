"""Functions that only compiled code calls are linked into their callers, and are no machine code of their own."""

from __future__ import annotations

import numpy as np
import pytest
from numba import njit

from clast.engine.compiler import STRICT, inlined, of_part, routine
from clast.engine.linking import Unfinished


@inlined
def twice(x: float) -> float:
    return 2.0 * x


@routine
def twice_of_twice(x: float) -> float:
    return twice(twice(x))


@of_part
def made(x: float) -> np.ndarray:
    return np.full(3, twice_of_twice(x))


@njit(**STRICT)
def entry(x: float) -> float:
    if x < 0.0:
        raise ValueError("below 0")
    return made(x).sum() + twice(x)


def test_what_is_linked_is_called_and_has_no_address() -> None:
    assert entry(1.5) == 3 * 4 * 1.5 + 2 * 1.5
    for function in (twice, twice_of_twice, made):
        (library,) = [each.library for each in function.dispatcher.overloads.values()]
        assert isinstance(library, Unfinished)
        assert library.get_pointer_to_function(f"cpython.{function.__name__}") == 0
    (own,) = [each.library for each in entry.overloads.values()]
    assert not isinstance(own, Unfinished)
    with pytest.raises(ValueError, match="below 0"):
        entry(-1.0)


def test_from_python_they_are_the_functions_that_they_are() -> None:
    assert twice_of_twice(2.0) == 8.0
