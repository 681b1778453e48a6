"""The pages of the documentation that are made from declarations, docstrings and scenes while the site is built."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
