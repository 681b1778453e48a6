"""Honeycomb sheets, and a table of how many of their bonds survive: two parts, one a file."""

from __future__ import annotations

from clast import hookimpl
from clast.plugins.registry import Registry
from clast_honeycomb import sheet, survivors

CLAST_API = 1


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the sheet and the table."""
    registry.generator("honeycomb", sheet.PART)
    registry.writer("survivors", survivors.PART)
