"""Parts of a scene as a run notes them: where each comes from, and a digest of its sources."""

from __future__ import annotations

import hashlib
from types import FunctionType
from typing import Any

from clast.config.scene import SceneConfig
from clast.engine.sources import source_files

Parts = dict[str, dict[str, str]]


def parts_of(config: SceneConfig) -> Parts:
    """Return every part a scene uses as ``kind.name``, with where it comes from and a digest of its source files."""
    return {
        f"{chosen.kind}.{chosen.name}": {"source": str(chosen.source), "digest": part_digest(chosen.part)}
        for chosen in config.chosen
    }


def part_digest(part: Any) -> str:
    """Return a digest of the source files of all functions a part consists of."""
    functions = [f for f in vars(part).values() if isinstance(f, FunctionType)]
    told = hashlib.sha256()
    for file in sorted(source_files(functions)):
        told.update(file.read_bytes())
    return told.hexdigest()[:24]


def changed(before: Parts, now: Parts) -> list[str]:
    """Return the names of parts whose sources have changed, writers left out: they compute nothing.

    >>> old, new = {"digest": "a", "source": "law.py"}, {"digest": "b", "source": "law.py"}
    >>> changed({"bond_model.mine": old, "writer.vtk": old}, {"bond_model.mine": new, "writer.vtk": new})
    ["bond_model 'mine' (law.py)"]
    """
    found = []
    for key in sorted(before.keys() & now.keys()):
        kind, _, name = key.partition(".")
        if before[key]["digest"] != now[key]["digest"] and kind != "writer":
            found.append(f"{kind} {name!r} ({now[key]['source']})")
    return found
