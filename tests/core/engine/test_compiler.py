"""Functions for compiled code: compiled there, plain in Python, and the same to the bit in both."""

from __future__ import annotations

from clast.engine.compiler import compiled, inlined, routine


@inlined
def third(x: float) -> float:
    return x / 3.0


@routine
def third_of_next(x: float, step: float = 1.0) -> float:
    return third(x + step)


@compiled
def both(x: float) -> tuple[float, float]:
    return third(x), third_of_next(x)


def test_inner_functions_are_compiled_into_entry_points() -> None:
    assert both(0.1) == both.py_func(0.1) == (0.1 / 3.0, 1.1 / 3.0)  # type: ignore[attr-defined]
    assert both.nopython_signatures  # type: ignore[attr-defined]


def test_inner_functions_called_from_python_run_as_they_are_written() -> None:
    assert third(0.1) == 0.1 / 3.0
    assert third_of_next(0.1, step=0.2) == (0.1 + 0.2) / 3.0
    assert third.__name__ == "third"
