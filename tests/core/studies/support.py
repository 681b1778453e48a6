"""Small studies that several tests run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import yaml

from clast.studies.config import StudyConfig, load_study
from tests.scenes import CRUSH, write

QUICK = {"time.end.strain": 0.02, "walls.upper.motion.velocity": [0, 0, "-100 mm/s"], "output.samples": 30}
"""Hundreds of steps instead of thousands."""


def study(folder: Path, scene: str = CRUSH, **keys: Any) -> StudyConfig:
    """Write a scene and a study of it, and load that."""
    return load_study(study_file(folder, scene, **keys))


def study_file(folder: Path, scene: str = CRUSH, **keys: Any) -> Path:
    """Write a scene and a study of it."""
    write(folder, scene, "base.yaml")
    given = {"base": "base.yaml", **keys}
    return write(folder, yaml.safe_dump(given, sort_keys=False), "try.yaml")
