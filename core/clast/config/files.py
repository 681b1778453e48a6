"""Files that a part reads as it is validated, such as a measured course or a shape."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, ValidationInfo


def _from_the_scene(given: Path, info: ValidationInfo) -> Path:
    folder = (info.context or {}).get("folder", Path())
    return (Path(folder) / given).resolve()


InputFile = Annotated[Path, AfterValidator(_from_the_scene)]
"""A path that starts from the folder of the scene, and is whole once validated: ``file: InputFile``."""
