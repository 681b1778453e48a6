"""Assembles the compiled step loop of a scene, or finds it on disk."""

from __future__ import annotations

import importlib.util
import os
import shutil
import stat
import sys
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

from clast.engine import compiler, state
from clast.engine.blueprint import Blueprint
from clast.engine.entry import Entry
from clast.engine.law_errors import law_files
from clast.engine.slots_text import slots_text
from clast.engine.sources import digest, reachable

TEMPLATE = Path(__file__).parent / "kernels"


@dataclass(frozen=True)
class Kernel:
    """The compiled loop of one kind of scene.

    Attributes
    ----------
    advance : (world, steps) -> int
        See ``kernels.step_loop.advance``.
    observe : (world, output) -> None
        See ``kernels.observe.observe``.
    energies : (world, moving, found) -> None
        See ``kernels.energies.energies``.
    near_walls : (particles, walls, slack, wall_slack, near) -> None
        See ``kernels.near_walls.near_walls``.
    gaps : (world, between, at_walls) -> None
        See ``kernels.gaps.gaps``.
    network : (world, moving, grain, inside, output) -> int
        See ``kernels.network.network``.
    virial : (world, moving, found) -> None
        See ``kernels.virial.virial``.
    digest : str
        Of every source that takes part.
    fresh : bool
        Whether it must be compiled before its first step.
    """

    advance: Callable[..., int]
    observe: Callable[..., None]
    energies: Callable[..., None]
    near_walls: Callable[..., None]
    gaps: Callable[..., None]
    network: Callable[..., int]
    virial: Callable[..., None]
    digest: str
    fresh: bool


def wanted_cache() -> Path:
    """Return where compiled loops should be kept: ``CLAST_CACHE``, or the user's cache folder."""
    named = os.environ.get("CLAST_CACHE")
    return Path(named) if named else Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "clast"


def cache_folder() -> Path:
    """Return where compiled loops are kept: where they should be, or in a temporary folder."""
    base = wanted_cache()
    try:
        base.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=base):
            return base
    except OSError:
        return _temporary_folder()


def _temporary_folder() -> Path:
    """Return this user's folder among the temporary files; code of others must never be loaded from there."""
    folder = Path(tempfile.gettempdir()) / f"clast-{os.getuid()}"
    folder.mkdir(mode=0o700, exist_ok=True)
    found = folder.lstat()
    own = stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o022
    return folder if own else Path(tempfile.mkdtemp(prefix="clast-"))


def assemble(plan: Blueprint, heard: Mapping[Callable[..., Any], Any] | None = None) -> Kernel:
    """Return the step loop for a blueprint, compiled at its first call or loaded from disk.

    Parameters
    ----------
    heard : mapping, optional
        What functions of laws gave in plain Python, to be told beside what the compiler says of them.

    Raises
    ------
    PluginError
        If a part's function cannot be imported by the loop.
    """
    text = slots_text(plan)
    helpers = _template_helpers()
    name = f"clast_kernel_{digest([*plan.functions(), *helpers], text, _template_text())}"
    folder, laws = cache_folder() / name, law_files(plan.functions(), heard or {})
    _write_package(folder, text)
    let_compiled_code_call([*plan.functions(), *helpers])
    package = _import_package(name, folder)
    advance, observe, energies, near_walls, gaps, network, virial = (
        Entry(getattr(_submodule(package, file), function), folder / "lock", laws)
        for file, function in (
            ("step_loop", "advance"),
            ("observe", "observe"),
            ("energies", "energies"),
            ("near_walls", "near_walls"),
            ("gaps", "gaps"),
            ("network", "network"),
            ("virial", "virial"),
        )
    )
    fresh = not advance.on_disk
    found = name.removeprefix("clast_kernel_")
    return Kernel(advance, observe, energies, near_walls, gaps, network, virial, found, fresh)


def _template_helpers() -> list[Callable[..., Any]]:
    """Return the plain functions that the templates themselves call."""
    from clast.maths import rotation, vec3

    modules = (rotation, vec3)
    return [f for m in modules for f in vars(m).values() if isinstance(f, FunctionType) and f.__module__ == m.__name__]


def _template_text() -> str:
    files = [*sorted(TEMPLATE.glob("*.py")), Path(state.__file__), Path(compiler.__file__)]
    return "".join(file.read_text() for file in files if file.name != "slots.py")


def _write_package(folder: Path, slots: str) -> None:
    """Write the package once; a half-written or racing one never gets its final name."""
    if (folder / "slots.py").exists():
        return
    folder.parent.mkdir(parents=True, exist_ok=True)
    draft = Path(tempfile.mkdtemp(prefix="draft-", dir=folder.parent))
    for file in TEMPLATE.glob("*.py"):
        shutil.copyfile(file, draft / file.name)
    (draft / "slots.py").write_text(slots)
    try:
        draft.rename(folder)
    except OSError:
        shutil.rmtree(draft, ignore_errors=True)


_registered: set[FunctionType] = set()


def let_compiled_code_call(functions: list[Callable[..., Any]]) -> None:
    """Let compiled code call the parts' plain functions, inlined into their callers."""
    from numba.extending import register_jitable

    for function in reachable(functions):
        if function not in _registered:
            register_jitable(**compiler.STRICT, **compiler.OF_PART)(function)
            _registered.add(function)


def _import_package(name: str, folder: Path) -> ModuleType:
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(
            name, folder / "__init__.py", submodule_search_locations=[str(folder)]
        )
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
    return sys.modules[name]


def _submodule(package: ModuleType, name: str) -> Any:
    return importlib.import_module(f"{package.__name__}.{name}")
