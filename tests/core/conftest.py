"""Fixtures of several tests of the core."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture
def in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Work in a folder of its own, so that messages name files as the user does."""
    monkeypatch.chdir(tmp_path)
