"""Reading an STL file so that everything wrong with it is told."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

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


class Content(NamedTuple):
    """Triangles of a file that have an area, (t, 3, 3) in its unit, and how many it holds that have none."""

    triangles: Triangles
    bare: int

    @property
    def left_out(self) -> tuple[str, ...]:
        """A sentence about those without an area; none where there are none."""
        if self.bare == 0:
            return ()
        have, are = ("have", "are") if self.bare > 1 else ("has", "is")
        count = len(self.triangles) + self.bare
        return (f"{self.bare} of {count} triangles of the file {have} no area and {are} left out",)


def content_of(path: Path) -> Content:
    """Return what an STL file holds. Programs that make surfaces leave triangles without an area behind.

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
def _read(path: Path, version: tuple[int, int]) -> Content:
    """Read a file; once for each version of it."""
    if version[1] > MOST_BYTES:
        raise ConfigError(f"{path}: has {version[1]:,} bytes, more than {MOST:,} triangles; make it coarser")
    try:
        content = path.read_bytes()
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}; check the path") from None
    triangles = _of_text(path, content) if _is_text(content) else _of_binary(path, content)
    where = f"{path}: "
    refuse_nowhere(where, triangles)
    bare = without_area(triangles)
    if bare.all():
        raise ConfigError(f"{where}holds no triangle that has an area; export it again")
    kept = triangles[~bare]
    refuse_far(where, kept)
    kept.setflags(write=False)
    return Content(kept, int(bare.sum()))


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


def refuse_bad(triangles: Triangles) -> None:
    """Refuse triangles that are written out and no surface: as :func:`content_of`, and those without an area.

    Raises
    ------
    ConfigError
    """
    refuse_nowhere("", triangles)
    bare = without_area(triangles)
    if bare.any():
        count = int(bare.sum())
        more = f", and {count - 1} others" if count > 1 else ""
        raise ConfigError(
            f"triangle {int(np.argmax(bare))}, counted from 0, has no area{more}; leave out what has none"
        )
    refuse_far("", triangles)


def refuse_nowhere(where: str, triangles: Triangles) -> None:
    """Refuse no or too many triangles, and corners that are nowhere.

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


def refuse_far(where: str, triangles: Triangles) -> None:
    """Refuse triangles that have an area, so far from the origin that nothing is known of their shape.

    Raises
    ------
    ConfigError
    """
    _, longest2 = _sides(triangles)
    far = np.abs(triangles).max(axis=(1, 2)) > FARTHEST * np.sqrt(longest2.min())
    if far.any():
        k = int(np.argmax(far))
        raise ConfigError(
            f"{where}triangle {k} has a corner {np.abs(triangles[k]).max():.3g} units from the origin, where numbers "
            "of this precision end; move the surface to the origin, or export it again"
        )


def without_area(triangles: Triangles) -> NDArray[np.bool_]:
    """Return which triangles, (t, 3, 3), have no area, (t,)."""
    sides, longest2 = _sides(triangles)
    area = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    return np.asarray(~(area > THIN * longest2))


def _sides(triangles: Triangles) -> tuple[Triangles, NDArray[np.float64]]:
    """Return the sides, (t, 3, 3), and the squares of the longest, (t,)."""
    sides = np.roll(triangles, -1, axis=1) - triangles
    return sides, (sides**2).sum(axis=2).max(axis=1)
