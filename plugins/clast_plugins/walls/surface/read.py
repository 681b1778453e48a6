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
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOGeometry import vtkSTLReader

    if version[1] > 84 + 50 * MOST and not _is_text(path):
        raise ConfigError(f"{path}: holds more than {MOST:,} triangles; make it coarser")
    complaints: list[str] = []
    reader = vtkSTLReader()
    for each in (reader, reader.GetExecutive()):
        each.AddObserver("ErrorEvent", _noting(complaints))
    reader.MergingOff()
    reader.SetFileName(str(path))
    reader.Update()
    found = reader.GetOutput()
    if complaints or found.GetNumberOfCells() == 0:
        raise ConfigError(f"{path}: is no STL file, neither text nor binary, or holds no triangle; export it again")
    corners = vtk_to_numpy(found.GetPoints().GetData()).astype(float)
    cells = vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    triangles = np.asarray(corners[cells])
    refuse_bad(f"{path}: ", triangles)
    triangles.setflags(write=False)
    return triangles


def _is_text(path: Path) -> bool:
    with path.open("rb") as file:
        return file.read(5) == b"solid"


def _noting(complaints: list[str]) -> object:
    def note(caller: object, event: str) -> None:
        complaints.append(event)

    return note


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
    lost = ~np.isfinite(triangles).all(axis=(1, 2))
    if lost.any():
        raise ConfigError(f"{where}triangle {int(np.argmax(lost))} has a corner that is no place; export it again")
    sides = np.roll(triangles, -1, axis=1) - triangles
    longest2 = (sides**2).sum(axis=2).max(axis=1)
    area = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    bare = ~(area > THIN * longest2)
    if bare.any():
        k, count = int(np.argmax(bare)), int(bare.sum())
        more = f", and {count - 1} others" if count > 1 else ""
        raise ConfigError(
            f"{where}triangle {k}, counted from 0, has no area{more}; repair the surface, where it was made or with a "
            "program such as MeshLab"
        )
