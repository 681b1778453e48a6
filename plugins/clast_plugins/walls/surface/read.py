"""Reading an STL file so that everything wrong with it is told."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from clast.errors import ConfigError

Triangles = NDArray[np.float64]
MOST = 2_000_000
"""Triangles of a surface."""

HEAD = 84
"""Bytes of a binary file before its triangles."""

TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
NOWHERE = 1e30
"""No corner is so far out, in any unit; its products with others can still be computed."""

MOST_BYTES = 300 * MOST
"""More than a text of so many triangles has."""

FARTHEST = 1e12
"""Largest coordinate in the longest sides of the smallest triangle: beyond, nothing is known of its shape."""

THIN = 1e-12
"""Area of a triangle, as a share of the square of its longest side, up to which it has none."""


def triangles_of(path: Path) -> Triangles:
    """Return the triangles of an STL file, (t, 3, 3), in its unit.

    Raises
    ------
    ConfigError
        There is no such file, it is none, or what it holds is no surface of triangles.
    """
    return _read(path, version(path))


def version(path: Path) -> tuple[int, int]:
    """Return when a file was changed, and how large it is.

    Raises
    ------
    ConfigError
        There is no such file.
    """
    try:
        about = path.stat()
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}; check the path") from None
    return about.st_mtime_ns, about.st_size


@lru_cache(maxsize=8)
def _read(path: Path, version: tuple[int, int]) -> Triangles:
    """Read a file; once for each version of it."""
    if version[1] > MOST_BYTES:
        raise ConfigError(f"{path}: has {version[1]:,} bytes, more than {MOST:,} triangles; make it coarser")
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}; check the path") from None
    triangles = _of_text(path, content) if _is_text(content) else _of_binary(path, content)
    refuse_bad(f"{path}: ", triangles)
    triangles.setflags(write=False)
    return triangles


def _is_text(content: bytes) -> bool:
    """Tell whether a file is an STL text: binary ones may begin with the same word."""
    begin = content[:1000]
    return begin[:5].lower() == b"solid" and b"facet" in begin.lower() and b"\0" not in begin


def _of_text(path: Path, content: bytes) -> Triangles:
    """Return the triangles of a text: three lines 'vertex x y z' for each 'facet'."""
    rows = []
    for number, line in enumerate(content.splitlines(), start=1):
        words = line.split()
        if words and words[0].lower() == b"vertex":
            try:
                rows.append([float(word) for word in words[1:4]])
            except ValueError:
                raise ConfigError(f"{path}:{number}: {line.decode(errors='replace').strip()!r} is no corner") from None
    facets = content.lower().count(b"facet normal")
    if len(rows) != 3 * facets or any(len(row) != 3 for row in rows):
        raise ConfigError(
            f"{path}: tells of {facets} triangles and holds {len(rows)} corners: cut off; export it again"
        )
    return np.array(rows, float).reshape(-1, 3, 3)


def _of_binary(path: Path, content: bytes) -> Triangles:
    """Return the triangles of a binary file: 80 bytes, a number, and 50 bytes a triangle."""
    if len(content) < HEAD:
        raise ConfigError(f"{path}: is no STL file, neither text nor binary; export it again")
    told, held = int.from_bytes(content[80:HEAD], "little"), (len(content) - HEAD) // TRIANGLE.itemsize
    if len(content) != HEAD + told * TRIANGLE.itemsize:
        raise ConfigError(
            f"{path}: tells of {told:,} triangles and is as long as {held:,}: cut off, or no STL file; export it again"
        )
    return np.frombuffer(content, TRIANGLE, offset=HEAD)["corners"].astype(float)


def refuse_bad(where: str, triangles: Triangles) -> None:
    """Refuse what is no surface: no or too many triangles, corners that are nowhere, triangles without an area.

    Raises
    ------
    ConfigError
    """
    if len(triangles) == 0:
        raise ConfigError(f"{where}holds no triangle")
    if len(triangles) > MOST:
        raise ConfigError(f"{where}holds {len(triangles):,} triangles, more than {MOST:,}; make it coarser")
    lost = ~(np.abs(triangles) < NOWHERE).all(axis=(1, 2))
    if lost.any():
        raise ConfigError(f"{where}triangle {int(np.argmax(lost))} has a corner that is no place; export it again")
    sides = np.roll(triangles, -1, axis=1) - triangles
    longest2 = (sides**2).sum(axis=2).max(axis=1)
    far = np.abs(triangles).max(axis=(1, 2)) > FARTHEST * np.sqrt(longest2.min())
    if far.any() and longest2.min() > 0.0:
        k = int(np.argmax(far))
        raise ConfigError(
            f"{where}triangle {k} has a corner {np.abs(triangles[k]).max():.3g} units from the origin, where numbers "
            "of this precision end; move the surface to the origin, or export it again"
        )
    area = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    bare = ~(area > THIN * longest2)
    if bare.any():
        k, count = int(np.argmax(bare)), int(bare.sum())
        more = f", and {count - 1} others" if count > 1 else ""
        raise ConfigError(
            f"{where}triangle {k}, counted from 0, has no area{more}; repair the surface, where it was made or with a "
            "program such as MeshLab"
        )
