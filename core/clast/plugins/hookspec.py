"""The one hook of Clast: a plugin registers its parts.

A plugin is a module (or a package) that states ``CLAST_API = 1`` and holds::

    from clast import hookimpl

    @hookimpl
    def clast_register(registry):
        registry.contact_law("my_law", MY_LAW)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pluggy

if TYPE_CHECKING:
    from clast.plugins.registry import Registry

PROJECT = "clast"
API_VERSION = 1

hookspec = pluggy.HookspecMarker(PROJECT)
hookimpl = pluggy.HookimplMarker(PROJECT)


@hookspec
def clast_register(registry: Registry) -> None:
    """Register the plugin's parts, each with the registry's method for its kind."""
