"""Generator: a sheet of spheres, each bonded to its six neighbours."""

from __future__ import annotations

from math import sqrt
from typing import Annotated

import numpy as np
from pydantic import Field
from scipy.spatial import cKDTree

from clast.config.quantities import Length
from clast.parts.generator import BondList, Generator, Packing, Site
from clast.parts.params import Params

GAP = 1e-6
"""Between neighbours, as a share of their diameter: rounding must not make them overlap."""


class Honeycomb(Params):
    """A hexagonal sheet in the x-z plane that stands on z = 0.

    Limits
    ------
    One size; every bond as thick as the spheres.

    Source
    ------
    Plain geometry.
    """

    material: Annotated[str, Field(examples=["glass"], description="Material of the spheres")]
    diameter: Annotated[Length, Field(gt=0, examples=["1 mm"], description="Diameter of a sphere")]
    columns: Annotated[int, Field(ge=1, examples=[6], description="Spheres in a row")]
    rows: Annotated[int, Field(ge=1, examples=[5], description="Rows")]


def generate(params: Honeycomb, site: Site) -> Packing:
    """Place rows, every other one half a step aside, and bond what touches."""
    d, n = params.diameter, params.columns * params.rows
    row, column = np.divmod(np.arange(n), params.columns)
    step = d * (1.0 + GAP)
    position = np.zeros((n, 3))
    position[:, 0] = step * (column + 0.5 * (row % 2))
    position[:, 2] = 0.5 * d + 0.5 * sqrt(3.0) * step * row
    near = cKDTree(position).query_pairs(1.1 * d, output_type="ndarray").astype(np.int64).reshape(-1, 2)
    ends = np.sort(near, axis=1)
    ends = ends[np.lexsort((ends[:, 1], ends[:, 0]))]
    bonds = BondList(ends, np.full(len(ends), d), np.full(len(ends), np.nan))
    return Packing(
        position=position,
        radius=np.full(n, 0.5 * d),
        material=[params.material] * n,
        velocity=np.zeros((n, 3)),
        spin=np.zeros((n, 3)),
        prescribed=np.zeros(n, bool),
        grain=np.zeros(n, np.int64),
        bonds=bonds,
        report={"bonds": len(ends)},
    )


PART = Generator("a hexagonal sheet of bonded spheres", Honeycomb, generate)
