"""Reading points and lines of VTKHDF, as the writer ``vtk`` and ``clast export --to vtkhdf`` leave them.

Source: VTKHDF file format 2.2, https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.errors import ConfigError
from clast.parts.generator import BondList
from clast_plugins.generators.particle_table import (
    ParticleTable,
    bonds_between,
    named_materials,
    numbered_from_zero,
)

LINES = 1
"""Lines are the second of the four kinds of cells in the tables of steps."""


def read_vtkhdf(path: Path, material: str | None, materials: list[str] | None) -> tuple[ParticleTable, BondList | None]:
    """Read the last step of a temporal PolyData: its points, with ``radius``, are particles, its lines bonds.

    Raises
    ------
    ConfigError
        The file is missing or no temporal PolyData with the point data ``radius``; a material has no name.
    """
    import h5py

    try:
        with h5py.File(path) as file:
            data = _last_step(file["VTKHDF"])
    except FileNotFoundError:
        raise ConfigError(f"{path}: there is no such file; check the path") from None
    except (OSError, KeyError, ValueError) as error:
        raise ConfigError(
            f"{path}: not a VTKHDF file with points over time as Clast writes them, or it is cut off: {error}"
        ) from None
    return _particles(path, data, material, materials)


def _last_step(root: Any) -> dict[str, NDArray[Any]]:
    """Return the points, their data and the lines of the last step.

    Raises
    ------
    KeyError, ValueError
        Something is missing, or the group holds something else.
    """
    steps = root["Steps"]
    part = int(steps["PartOffsets"][-1])
    count = int(root["NumberOfPoints"][part])

    def rows(column: Any, first: int, number: int) -> NDArray[Any]:
        found = np.asarray(column[first : first + number])
        if len(found) != number:
            raise ValueError(f"{column.name} has {len(found)} rows of {number}")
        return found

    data = {"position": rows(root["Points"], int(steps["PointOffsets"][-1]), count)}
    for name in ("radius", "id", "material", "grain"):
        data[name] = rows(root["PointData"][name], int(steps["PointDataOffsets"][name][-1]), count)
    ends = int(root["Lines"]["NumberOfConnectivityIds"][part])
    first = int(steps["ConnectivityIdOffsets"][-1][LINES])
    data["ends"] = rows(root["Lines"]["Connectivity"], first, ends).astype(np.int64).reshape(-1, 2)
    return data


def _particles(
    path: Path, data: dict[str, NDArray[Any]], material: str | None, materials: list[str] | None
) -> tuple[ParticleTable, BondList | None]:
    radius, ids = data["radius"].astype(np.float64), data["id"]
    if not len(radius) or not (radius > 0.0).all():
        raise ConfigError(f"{path}: its last step holds no points, or some whose radius is not above 0")
    particles = ParticleTable(
        ids.tolist(),
        data["position"].astype(np.float64),
        radius,
        named_materials(path, data["material"].tolist(), 0, material, materials),
        lambda k: f"{path}: point with id {ids[k]}",
        numbered_from_zero(data["grain"].astype(np.int64)),
    )
    ends = data["ends"]
    return particles, bonds_between(particles, ends, lambda k: f"{path}: line {k}") if len(ends) else None
