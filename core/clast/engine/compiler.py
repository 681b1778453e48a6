"""How Clast asks numba to compile: strict floating point, C-like division, no exceptions inside loops."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from numba import njit

F = TypeVar("F", bound=Callable[..., Any])


def compiled(function: F) -> F:
    """Compile an entry point called from Python; the machine code is kept on disk."""
    return njit(cache=True, error_model="numpy", nogil=True)(function)  # type: ignore[no-any-return]


def routine(function: F) -> F:
    """Compile a function of its own, called from compiled code only."""
    return njit(error_model="numpy", nogil=True)(function)  # type: ignore[no-any-return]


def inlined(function: F) -> F:
    """Compile a function into its callers: what lets a loop over lanes vectorise."""
    return njit(error_model="numpy", nogil=True, forceinline=True)(function)  # type: ignore[no-any-return]
