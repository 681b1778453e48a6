"""Which functions a part consists of, and a digest that changes whenever any of them does.

Compiled code on disk is only right as long as the sources it came from are unchanged. The digest covers the source
file of every function reachable from a part, and the value of every plain constant those functions read.
"""

from __future__ import annotations

import dis
import hashlib
import sys
from collections.abc import Callable, Iterable, Iterator
from importlib.util import find_spec, resolve_name
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

from clast.errors import PluginError

FOREIGN = {"numba", "numpy"} | sys.stdlib_module_names


def names_used(code: CodeType) -> set[str]:
    """Return the global names a code object and those nested in it refer to."""
    names = set(code.co_names)
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            names |= names_used(constant)
    return names


def referred(function: FunctionType) -> dict[str, Any]:
    """Return the global objects a function refers to, by name; those of a module as ``module.name``."""
    found: dict[str, Any] = {}
    names = sorted(names_used(function.__code__))
    for name in names:
        value = function.__globals__.get(name)
        if isinstance(value, ModuleType) and value.__name__.split(".")[0] not in FOREIGN:
            found |= {f"{name}.{inner}": getattr(value, inner) for inner in names if hasattr(value, inner)}
        elif value is not None:
            found[name] = value
    return found


def reachable(functions: Iterable[Callable[..., Any]]) -> list[FunctionType]:
    """Return the given functions and all plain functions they call, each once, callees first."""
    order: list[FunctionType] = []
    seen: set[FunctionType] = set()

    def visit(function: Any) -> None:
        function = getattr(function, "py_func", function)  # what an author compiled is read as written
        if not isinstance(function, FunctionType) or function in seen:
            return
        if function.__module__.split(".")[0] in FOREIGN:
            return
        seen.add(function)
        for target in referred(function).values():
            visit(target)
        order.append(function)

    for function in functions:
        visit(function)
    return order


def address(function: Callable[..., Any]) -> tuple[str, str]:
    """Return module and name under which a part's function can be imported.

    Raises
    ------
    PluginError
        For lambdas and functions made inside others, which the compiled loop cannot import.
    """
    name = getattr(function, "__qualname__", "")
    if not isinstance(function, FunctionType) or "<" in name:
        where = getattr(function, "__module__", "?")
        raise PluginError(
            f"{where}: {name or function!r} is not a function at the top level of a file; "
            "write it there with 'def', so that the compiled loop can import it"
        )
    return function.__module__, name


def constant_text(value: Any) -> str | None:
    """Return the text of a plain constant or an array, None for anything else."""
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{value.shape}{value.tobytes().hex()}"
    if isinstance(value, bool | int | float | str):
        return repr(value)
    if isinstance(value, tuple) and all(constant_text(v) is not None for v in value):
        return repr(value)
    return None


def source_files(functions: Iterable[Callable[..., Any]]) -> set[Path]:
    """Return the files of all functions reachable from the given ones, of classes they use, and of late imports."""
    files: set[Path] = set()
    for function in reachable(functions):
        files |= set(files_imported_inside(function))
        used = [v for v in referred(function).values() if isinstance(v, type)]
        modules = {function.__module__, *(each.__module__ for each in used)}
        for name in modules:
            file = getattr(sys.modules.get(name), "__file__", None)
            if file is not None and name.split(".")[0] not in FOREIGN:
                files.add(Path(file))
    return files


def files_imported_inside(function: FunctionType) -> Iterator[Path]:
    """Yield the files of those modules of its own package that a function imports when it is called.

    They are found without importing them: they may need libraries that are slow to load.
    """
    package = function.__module__.split(".")[0]
    for name, inner in imports_inside(function.__code__, function.__globals__.get("__package__") or ""):
        spec = find_spec(name) if name.split(".")[0] == package else None
        if spec is None:
            continue
        submodules = (find_spec(f"{name}.{each}") for each in inner) if spec.submodule_search_locations else ()
        yield from (Path(each.origin) for each in (spec, *submodules) if each is not None and each.origin is not None)


def imports_inside(code: CodeType, package: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the modules that a code object and those nested in it import, with the names taken from each."""
    instructions = list(dis.get_instructions(code))
    for k, instruction in enumerate(instructions):
        if instruction.opname == "IMPORT_NAME":
            level, names = instructions[k - 2].argval, instructions[k - 1].argval
            if package or not level:
                yield resolve_name("." * level + instruction.argval, package), names or ()
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from imports_inside(constant, package)


def digest(functions: Iterable[Callable[..., Any]], *texts: str) -> str:
    """Return a digest of all sources reachable from the functions, their constants, and further texts."""
    told = hashlib.sha256()
    functions = list(functions)
    for function in reachable(functions):
        for name, value in referred(function).items():
            text = constant_text(value)
            if text is not None:
                told.update(f"{function.__qualname__}.{name}={text}\n".encode())
    for file in sorted(source_files(functions)):
        told.update(file.read_bytes())
    for text in texts:
        told.update(text.encode())
    return told.hexdigest()[:24]
