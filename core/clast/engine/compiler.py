"""How Clast asks numba to compile: strict floating point, C-like division, no exceptions inside loops."""

from __future__ import annotations

from collections.abc import Callable
from functools import update_wrapper
from typing import Any, TypeVar, cast

from numba import njit, types
from numba.extending import typeof_impl

from clast.engine.linking import LinkingCompiler

F = TypeVar("F", bound=Callable[..., Any])

STRICT: dict[str, Any] = {"error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}
INNER = STRICT | {"no_cpython_wrapper": True, "_nrt": False, "pipeline_class": LinkingCompiler}
"""For functions that only compiled code calls. Doors for Python and C in each of them would take a third of the whole
time of compiling, counting who holds which table a sixth, machine code of their own a tenth: they make no tables, the
entries hold all they are given, and they are linked into the entries.
"""
OF_PART = {"forceinline": True, "_nrt": True}
"""For the plain functions of parts, which may make tables of their own."""


class Inner:
    """A function for compiled code to call; called from Python, it runs as the plain function it is."""

    def __init__(self, function: Callable[..., Any], **options: bool) -> None:
        self.py_func = function
        self.dispatcher = njit(**INNER | options)(function)
        update_wrapper(self, function)

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Run it in Python."""
        return self.py_func(*arguments, **named)


@typeof_impl.register(Inner)  # type: ignore[untyped-decorator, unused-ignore]
def _type_of(function: Inner, context: Any) -> types.Dispatcher:
    """Tell numba what it finds where compiled code names such a function."""
    return types.Dispatcher(function.dispatcher)


def compiled(function: F) -> F:
    """Compile an entry point called from Python; the machine code is kept on disk."""
    return njit(cache=True, **STRICT)(function)  # type: ignore[no-any-return]


def routine(function: F) -> F:
    """Compile a function of its own, called from compiled code only."""
    return cast(F, Inner(function))


def inlined(function: F) -> F:
    """Compile a function into its callers: what lets a loop over lanes vectorise."""
    return cast(F, Inner(function, forceinline=True))


def of_part(function: F) -> F:
    """Compile a part's own function into its callers."""
    return cast(F, Inner(function, **OF_PART))


def written_out(function: F) -> F:
    """Compile a function as if its text stood in its callers: needed where it returns a table it did not make."""
    return cast(F, njit(inline="always", **STRICT)(function))
