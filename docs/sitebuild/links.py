"""Links that lead out of docs/: pages are read on a code host too, so they name files as they lie in the repository."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from sitebuild import DOCS, ROOT

_LINK = re.compile(r"(\]\()([^)\s#]+)")
_FOLDERS = {"docs/decisions": "decisions/index.md"}
SCENES = "configs/index.md"
"""Page that stands for every folder of scenes."""


def relink(markdown: str, page: Path) -> str:
    """Return the text of a page with its links to files as the site has them.

    Parameters
    ----------
    markdown : str
    page : Path
        The file it comes from.

    Examples
    --------
    >>> relink("[a scene](../configs/crush_grain.yaml)", DOCS / "studies.md")
    '[a scene](configs/crush_grain.yaml)'
    """
    here = PurePosixPath(place(page)).parent

    def moved(link: re.Match[str]) -> str:
        target = page.parent / link[2]
        if _elsewhere(link[2]) or not target.exists():
            return link[0]  # a wrong one is left for mkdocs to find
        return link[1] + os.path.relpath(place(target), here)

    return _LINK.sub(moved, markdown)


def place(file: Path) -> str:
    """Return where a file or folder of the repository lies in the site, as mkdocs names it.

    >>> place(ROOT / "README.md"), place(DOCS / "theory.md"), place(ROOT / "configs" / "paper")
    ('index.md', 'theory.md', 'configs/index.md')
    """
    inside = file.resolve().relative_to(ROOT).as_posix()
    if inside == "README.md":
        return "index.md"
    if file.is_dir():
        return _FOLDERS.get(inside, SCENES)
    return inside.removeprefix("docs/")


def linked_outside(pages: list[Path]) -> Iterator[Path]:
    """Yield the files outside docs/ that pages link to, each once."""
    targets = (page.parent / link[2] for page in pages for link in _LINK.finditer(page.read_text(encoding="utf-8")))
    found = {target.resolve() for target in targets if target.is_file()}
    yield from sorted(file for file in found if not file.is_relative_to(DOCS))


def _elsewhere(target: str) -> bool:
    return "://" in target or target.startswith("mailto:")
