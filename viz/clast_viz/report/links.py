"""Links from a page to the files of a folder, so that both can be moved together."""

from __future__ import annotations

import base64
import os
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple
from urllib.parse import quote

FILES = {
    "recording.rrd": "recording, for the rerun viewer",
    "particles.vtkhdf": "particles and bonds, for ParaView",
    "results.h5": "everything measured",
    "curves.csv": "curves as a table",
    "summary.json": "summary",
    "config.yaml": "the scene as run",
    "grains/history.csv": "grains over strain; more tables lie beside it",
    "tracks_particles.csv": "tracks of particles",
    "tracks_bonds.csv": "tracks of bonds",
}


class Link(NamedTuple):
    """A file of a folder: its address relative to the page, its name, what it is, and how large."""

    address: str
    name: str
    what: str
    size: str


def links(folder: Path, page: Path, files: Mapping[str, str] = FILES) -> list[Link]:
    """Return links to the files that a folder holds, of those that are known: name -> what it is."""
    return [
        Link(address(folder / name, page), name, what, size_text((folder / name).stat().st_size))
        for name, what in files.items()
        if (folder / name).is_file()
    ]


def address(target: Path, page: Path) -> str:
    """Return the address of a file or folder relative to the page, as a link has it.

    >>> address(Path("runs/grain 1/results.h5"), Path("runs/report.html"))
    'grain%201/results.h5'
    """
    relative = Path(os.path.relpath(target.resolve(), page.resolve().parent)).as_posix()
    return quote(f"./{relative}" if ":" in relative.partition("/")[0] else relative)


def data_address(png: Path) -> str:
    """Return a PNG as an address that holds the picture itself."""
    return "data:image/png;base64," + base64.b64encode(png.read_bytes()).decode("ascii")


def size_text(size: int) -> str:
    """Return the size of a file.

    >>> size_text(512), size_text(5_030_669)
    ('512 B', '5.0 MB')
    """
    for factor, unit in ((10**9, "GB"), (10**6, "MB"), (10**3, "kB")):
        if size >= factor:
            return f"{size / factor:.1f} {unit}"
    return f"{size} B"
