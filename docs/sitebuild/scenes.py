"""The page of the ready scenes: every file in configs/, with the comment it begins with."""

from __future__ import annotations

from functools import lru_cache
from itertools import groupby, takewhile
from pathlib import Path

from clast import load
from clast.config.yaml_loader import read_document
from clast.plugins.registered import Registered
from sitebuild import ROOT

CONFIGS = ROOT / "configs"


def scene_files() -> list[Path]:
    """Return all scenes, studies and calibrations in configs/, those of one folder together."""
    return sorted(CONFIGS.rglob("*.yaml"), key=lambda file: (file.parent, file.name))


def scenes_with(entry: Registered) -> list[Path]:
    """Return the scene made to show a part; where there is none, two ready ones that use it."""
    own = CONFIGS / "parts" / entry.kind / f"{entry.name}.yaml"
    return [own] if own.is_file() else _users().get((entry.kind, entry.name), [])[:2]


@lru_cache(maxsize=1)
def _users() -> dict[tuple[str, str], list[Path]]:
    """Return the ready scenes that use each part, those with the shortest names first: they are the plainest."""
    found: dict[tuple[str, str], list[Path]] = {}
    for file in sorted(
        scene_files(), key=lambda file: (len(file.relative_to(CONFIGS).parts), len(file.name), file.name)
    ):
        if "materials" in read_document(file).data:
            for part in {(chosen.kind, chosen.name) for chosen in load(file).chosen}:
                found.setdefault(part, []).append(file)
    return found


def scenes_page() -> str:
    """Return the page, a table for each folder."""
    lines = ["# Ready scenes", "", "Run one with `clast run FILE`, or copy it and change what you like.", ""]
    for folder, files in groupby(scene_files(), key=lambda file: file.parent):
        lines += [f"## {folder.relative_to(ROOT).as_posix()}", "", "| file | shows |", "|---|---|"]
        lines += [_row(file) for file in files] + [""]
    return "\n".join(lines)


def _row(file: Path) -> str:
    return f"| [{file.name}]({file.relative_to(CONFIGS).as_posix()}) | {first_words(file)} |"


def first_words(file: Path) -> str:
    """Return the first paragraph of the comment that a file begins with, in one line."""
    lines = file.read_text(encoding="utf-8").splitlines()
    comment = [line.removeprefix("#").strip() for line in takewhile(lambda line: line.startswith("#"), lines)]
    return " ".join(takewhile(bool, comment)).replace("|", "\\|")
