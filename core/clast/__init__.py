"""Clast: a discrete element framework for granules that break.

``load`` reads a scene, ``Simulation`` runs it, ``open_run`` reads the results, ``hookimpl`` marks a plugin's
hook. Each is imported when first used, so that ``clast --help`` stays quick.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from clast.about import VERSION

if TYPE_CHECKING:
    from clast.config.scene import load
    from clast.exporting import export_run
    from clast.plugins.hookspec import hookimpl
    from clast.results.run import open_run
    from clast.session import run_scene
    from clast.simulation import Simulation

__all__ = ["Simulation", "__version__", "export_run", "hookimpl", "load", "open_run", "run_scene"]

__version__ = VERSION

_HOMES = {
    "Simulation": "clast.simulation",
    "export_run": "clast.exporting",
    "hookimpl": "clast.plugins.hookspec",
    "load": "clast.config.scene",
    "open_run": "clast.results.run",
    "run_scene": "clast.session",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'clast' has no attribute {name!r}")
    return getattr(import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
