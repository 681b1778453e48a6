"""Linking: what only compiled code calls is linked into its callers unfinished, and finished there, once.

Numba makes machine code of every function, and optimises it together with all that it calls; then its callers do so
again. The classes here stand in numba's own places for both: a pipeline, as numba's documentation of customised
compilers has it, and the library in which a function's code is kept.
"""

from __future__ import annotations

from typing import Any

from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.core.compiler_machinery import FunctionPass, register_pass
from numba.core.typed_passes import NopythonTypeInference


class Unfinished(JITCodeLibrary):  # type: ignore[misc, unused-ignore]
    """Code to be linked into other code; it has no address of its own."""

    @property
    def codegen(self) -> Any:
        """What made it, but for environments."""
        return WithoutEnvironment(self._codegen)

    def get_pointer_to_function(self, name: str) -> int:
        """Return 0, as for what is not there: callers are linked, they do not jump."""
        self._ensure_finalized()
        return 0

    def _optimize_final_module(self) -> None:
        """Leave that to the callers."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True


class WithoutEnvironment:
    """Numba's maker of code, where there is no address at which to note the environment of a Python function."""

    def __init__(self, codegen: Any) -> None:
        self._codegen = codegen

    def __getattr__(self, name: str) -> Any:
        return getattr(self._codegen, name)

    def set_env(self, name: str, environment: Any) -> None:
        """Note nothing."""


@register_pass(mutates_CFG=False, analysis_only=False)
class KeepUnfinished(FunctionPass):  # type: ignore[misc, unused-ignore]
    """Pass that chooses where the code of a function is kept."""

    _name = "keep_unfinished"

    def __init__(self) -> None:
        FunctionPass.__init__(self)

    def run_pass(self, state: Any) -> bool:
        """Choose it, before there is any code."""
        state.library = Unfinished(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        return True


class LinkingCompiler(Compiler):  # type: ignore[misc, unused-ignore]
    """The compiler of functions that only compiled code calls."""

    def define_pipelines(self) -> list[Any]:
        """Return numba's pipelines with one pass more."""
        pipelines: list[Any] = super().define_pipelines()
        for each in pipelines:
            each.add_pass_after(KeepUnfinished, NopythonTypeInference)
            each.finalize()
        return pipelines
