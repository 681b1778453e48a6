"""About Clast: its version, and the folder it is installed in."""

from __future__ import annotations

from pathlib import Path

VERSION = "0.1.0"

HOME = Path(__file__).resolve().parent
"""Folder of the package ``clast``."""
