"""Plain data: a validated scene, or a piece of it, as YAML could hold it."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from pathlib import Path
from typing import Any

from clast.config.choice import Chosen, plain_fields
from clast.config.part_beside import Joined
from clast.parts.params import Params


def plain_data(value: Any, folder: Path) -> Any:
    """Return a validated value as plain data in SI, as it could be written in YAML; what is None is left out.

    Parameters
    ----------
    value : Params, Chosen, mapping, sequence or number
    folder : Path
        Where relative paths start; they become absolute.
    """
    if isinstance(value, Chosen | Joined):
        return plain_data(value.plain(), folder)
    if isinstance(value, Params):
        return plain_data({key: inner for key, inner in plain_fields(value).items() if inner is not None}, folder)
    if isinstance(value, Mapping):
        return {str(key): plain_data(inner, folder) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [plain_data(inner, folder) for inner in value]
    if isinstance(value, Path):
        return str(folder / value)
    return value.value if isinstance(value, Enum) else value
