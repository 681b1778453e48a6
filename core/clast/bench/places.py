"""Where the benchmark finds its scenes: in the installed package, or among the sources of Clast."""

from __future__ import annotations

from pathlib import Path

INSTALLED = Path(__file__).parent / "configs"
IN_THE_SOURCES = Path(__file__).parents[3] / "configs"


def scene_file(name: str) -> Path:
    """Return the file of a scene."""
    if INSTALLED.is_dir():
        return INSTALLED / f"{name}.yaml"
    beside = IN_THE_SOURCES / "benchmarks" / f"{name}.yaml"
    return beside if beside.exists() else IN_THE_SOURCES / f"{name}.yaml"
