"""What is known of a part and of its plugin: where they come from, and why a plugin failed."""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from clast.errors import PluginError, one_line
from clast.parts.params import Params
from clast.plugins.blame import plugin_line


@dataclass(frozen=True)
class Source:
    """Where a plugin comes from.

    Attributes
    ----------
    plugin : str
        Name of the entry point, or of the file.
    origin : str
        Distribution that brought it, or the path of the file.
    version : str
        Version of the distribution; empty for a file.
    """

    plugin: str
    origin: str
    version: str = ""

    def __str__(self) -> str:
        return f"{self.origin} {self.version}".strip()


@dataclass(frozen=True)
class Registered:
    """A part under its name."""

    kind: str
    name: str
    part: Any
    source: Source

    @property
    def file(self) -> Path | None:
        """File that declares the part's parameters, where Python knows it."""
        found = inspect.getsourcefile(self.part.Params)
        return Path(found) if found else None

    def part_for(self, params: Params) -> Any:
        """Return the part that given parameters ask for: its variant where it has any, or the part itself.

        Raises
        ------
        PluginError
            If the part's ``variant`` fails or returns something else than a part of this kind.
        """
        variant = getattr(self.part, "variant", None)
        if variant is None:
            return self.part
        where = f"{self.kind} {self.name!r} of plugin {self.source.plugin!r}: 'variant'"
        try:
            found = variant(params)
        except Exception as error:
            raise PluginError(
                f"{where} raised {one_line(error)} in {plugin_line(error) or 'an unknown line'}"
            ) from error
        if not isinstance(found, type(self.part)):
            raise PluginError(f"{where} must return a {type(self.part).__name__}, given {found!r}")
        return found


@dataclass(frozen=True)
class Failure:
    """A plugin that could not be loaded, and why."""

    source: Source
    error: Exception

    @property
    def reason(self) -> str:
        """File and line, where they are the plugin's, and what was raised."""
        place = plugin_line(self.error)
        return f"{place}: {one_line(self.error)}" if place else one_line(self.error)

    def __str__(self) -> str:
        return f"plugin {self.source.plugin!r} ({self.source}) could not be loaded: {self.reason}"
