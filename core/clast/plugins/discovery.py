"""Finding plugins: installed ones through entry points, single files named in a scene.

Installed plugins are loaded one by one. One that fails is remembered, and reported only when a scene needs a
part that is missing: a broken plugin must not stop the scenes that do without it.
"""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from importlib.machinery import SourceFileLoader
from importlib.metadata import EntryPoint, entry_points
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType
from typing import Any

import pluggy

from clast.errors import PluginError, one_line
from clast.plugins import hookspec
from clast.plugins.blame import FILE_MODULE, GROUP, OWN_DISTRIBUTION, line_in
from clast.plugins.nearest import nearest_name, suggestion
from clast.plugins.registered import Failure, Registered, Source
from clast.plugins.registry import NameTakenError, Registry

CHOICE = "CLAST_PLUGINS"


def discover(files: Sequence[str | Path] = (), folder: Path | None = None) -> Registry:
    """Registry with the parts of every installed plugin, and of the files named.

    Parameters
    ----------
    files : sequence of paths
        Python files that hold plugins, as a scene names them under ``plugins``.
    folder : Path, optional
        Folder that relative paths start from; the working folder by default.

    Raises
    ------
    PluginError
        A file cannot be loaded, two plugins want one name, or ``CLAST_PLUGINS`` names an unknown plugin.

    Notes
    -----
    ``CLAST_PLUGINS=none`` leaves out all installed plugins but Clast's own, ``CLAST_PLUGINS=a,b`` all but
    Clast's own and those two.
    """
    registry = _installed(os.environ.get(CHOICE)).copy()
    for file in files:
        load_file((folder or Path()) / file, registry)
    return registry


def listing(files: Sequence[str | Path] = ()) -> Registry:
    """Return the same for a list of what is there: plugins that want a name that is taken count as broken.

    Raises
    ------
    PluginError
        A file cannot be loaded, or ``CLAST_PLUGINS`` names an unknown plugin.
    """
    registry = Registry()
    load_entry_points(entry_points(group=GROUP), os.environ.get(CHOICE), registry, conflicts_stop=False)
    for file in files:
        load_file(Path(file), registry)
    return registry


def parts_of(what: str | Path) -> list[Registered]:
    """Parts that a file brings, or an installed plugin or distribution, or all parts of one name.

    Raises
    ------
    PluginError
        The file cannot be loaded, or nothing has that name.
    """
    if Path(what).suffix == ".py":
        registry, path = discover([what]), str(Path(what).resolve())
        return [entry for entry in registry if entry.source.origin == path]
    registry, name = discover(), str(what)
    found = [each for each in registry if name in (each.name, each.source.plugin, each.source.origin)]
    broken = [each for each in registry.failures if name in (each.source.plugin, each.source.origin)]
    if broken:
        raise PluginError(str(broken[0]))
    if not found:
        known = {text for each in registry for text in (each.name, each.source.plugin)}
        near = nearest_name(name, known)
        hint = f"did you mean {near!r}?" if near else "'clast plugins' lists all; a file ends with .py"
        raise PluginError(f"no part or plugin is named {name!r}; {hint}")
    return found


@lru_cache(maxsize=8)
def _installed(choice: str | None) -> Registry:
    registry = Registry()
    load_entry_points(entry_points(group=GROUP), choice, registry)
    return registry


def load_entry_points(
    found: Iterable[EntryPoint], choice: str | None, registry: Registry, conflicts_stop: bool = True
) -> None:
    """Load entry points one by one into ``registry``; keep the error of each one that fails.

    Raises
    ------
    PluginError
        ``choice`` names no plugin; and where ``conflicts_stop``: two distributions share an entry-point name, or two
        plugins a part's name.
    """
    points = sorted(found, key=lambda point: (source_of(point).origin != OWN_DISTRIBUTION, point.name))
    shared = list(_shared_names(points))
    if shared and conflicts_stop:
        raise shared[0].error
    registry.failures += shared
    points = [point for point in points if source_of(point) not in [each.source for each in shared]]
    chosen = _chosen(points, choice)
    registry.blocked += [source_of(point) for point in points if point not in chosen]
    for point in chosen:
        source = source_of(point)
        try:
            register(point.load(), source, registry)
        except Exception as error:
            if conflicts_stop and isinstance(error, NameTakenError):
                raise
            registry.failures.append(Failure(source, error))


def source_of(point: EntryPoint) -> Source:
    """Distribution and version behind an entry point."""
    if point.dist is None:
        return Source(point.name, origin=point.value)
    return Source(point.name, origin=point.dist.name, version=point.dist.version)


def register(plugin: Any, source: Source, registry: Registry) -> None:
    """Check a loaded plugin and let it register its parts.

    Raises
    ------
    PluginError
        It states no ``CLAST_API`` or another one, or has no ``clast_register`` marked with ``hookimpl``.
    """
    _check_api(plugin)
    manager = pluggy.PluginManager(hookspec.PROJECT)
    manager.add_hookspecs(hookspec)
    manager.register(plugin, name=source.plugin)
    try:
        manager.check_pending()
    except pluggy.PluginValidationError as error:
        raise PluginError(f"{error}; the only hook is 'clast_register'") from None
    if not manager.hook.clast_register.get_hookimpls():
        raise PluginError(
            "registers nothing: a plugin needs a function 'clast_register(registry)' marked with '@hookimpl' (from "
            "clast import hookimpl)"
        )
    with registry.registering(source):
        manager.hook.clast_register(registry=registry)


def load_file(path: Path, registry: Registry) -> None:
    """Load one Python file as a plugin.

    The module's name holds a digest of path and contents, so an edited file is never taken for its old self.

    Raises
    ------
    PluginError
        The file is missing, raises when executed, or is not a plugin.
    """
    try:
        path = path.resolve(strict=True)
        digest = hashlib.sha256(f"{path}\0".encode() + path.read_bytes()).hexdigest()[:12]
    except OSError as error:
        raise PluginError(f"{path}: {error.strerror or error}") from None
    source = Source(plugin=path.name, origin=str(path))
    try:
        module = _execute(path, f"{FILE_MODULE}{path.stem}_{digest}")
        register(module, source, registry)
    except NameTakenError:
        raise
    except (Exception, SystemExit) as error:
        raise PluginError(f"{path}{line_in(path, error)}: {one_line(error)}") from error


def _execute(path: Path, name: str) -> ModuleType:
    if name in sys.modules:
        return sys.modules[name]
    loader = SourceFileLoader(name, str(path))
    spec = spec_from_loader(name, loader)
    if spec is None:
        raise PluginError("Python cannot load it")
    module = module_from_spec(spec)
    sys.modules[name] = module
    try:
        # not exec_module of the loader: its .pyc is trusted by time stamp, too coarse for a file just edited
        exec(loader.source_to_code(path.read_bytes(), str(path)), module.__dict__)
    except BaseException:
        del sys.modules[name]
        raise
    return module


def _check_api(plugin: Any) -> None:
    stated = getattr(plugin, "CLAST_API", None)
    if stated == hookspec.API_VERSION:
        return
    if stated is not None and not isinstance(stated, int):
        raise PluginError(
            f"states CLAST_API = {stated!r}; a whole number is needed: CLAST_API = {hookspec.API_VERSION}"
        )
    if stated is None:
        raise PluginError(f"does not state its API; add 'CLAST_API = {hookspec.API_VERSION}' to the plugin")
    raise PluginError(
        f"written for CLAST_API {stated}, this Clast speaks {hookspec.API_VERSION}; update the plugin or Clast"
    )


def _shared_names(points: Sequence[EntryPoint]) -> Iterator[Failure]:
    """Yield a failure for each plugin whose name another distribution's plugin has."""
    owners: dict[str, Source] = {}
    for point in points:
        source = source_of(point)
        other = owners.setdefault(point.name, source)
        if other != source:
            text = (
                f"two distributions bring a plugin named {point.name!r}: {other} and {source}; "
                "uninstall one of them, or rename its entry point"
            )
            yield Failure(source, PluginError(text))


def _chosen(points: Sequence[EntryPoint], choice: str | None) -> list[EntryPoint]:
    own = [point for point in points if source_of(point).origin == OWN_DISTRIBUTION]
    if choice is None or not choice.strip():
        return list(points)
    if choice.strip() == "none":
        return own
    wanted = {name.strip() for name in choice.split(",") if name.strip()}
    known = {point.name for point in points}
    for name in sorted(wanted - known):
        raise PluginError(f"{CHOICE}: no plugin named {name!r} is installed; {suggestion(name, known)}")
    return [point for point in points if point in own or point.name in wanted]
