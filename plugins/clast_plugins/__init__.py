"""Clast's own parts, one per file, registered on the same road as anybody's plugin."""

from __future__ import annotations

from importlib import import_module
from pkgutil import walk_packages

from clast import hookimpl
from clast.plugins.registry import Registry

CLAST_API = 1


@hookimpl
def clast_register(registry: Registry) -> None:
    """Call ``clast_register`` of every module in this package that has one.

    Modules named ``*_kernel`` hold compiled code and are left to the parts that use them: registering must
    not import numba.
    """
    for found in walk_packages(__path__, prefix=f"{__name__}."):
        if found.name.endswith("_kernel"):
            continue
        module = import_module(found.name)
        register = getattr(module, "clast_register", None)
        if register is not None:
            register(registry)
