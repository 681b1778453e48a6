"""Conflict: what to tell where two plugins bring a part of one kind under one name."""

from __future__ import annotations

from clast.plugins.registered import Registered, Source


def conflict(taken: Registered, second: Source) -> str:
    """Return which two plugins bring a part of one kind and name, and what to do."""
    kind = taken.kind.replace("_", " ")
    of_files = not taken.source.version and not second.version
    remedy = "take one of the files out" if of_files else "uninstall one, or leave one out with CLAST_PLUGINS"
    return (
        f"two plugins bring a {kind} named {taken.name!r}: {taken.source.plugin!r} ({taken.source}) and "
        f"{second.plugin!r} ({second}); rename one of them, {remedy}"
        + ("" if of_files else "=<the plugins to load> or CLAST_PLUGINS=none")
    )
