"""From file: particles and bonds read from CSV tables, from a data file of LAMMPS, or from a VTKHDF file."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from clast import hookimpl
from clast.errors import about
from clast.parts.generator import BondList, Generator, Packing, Site
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.generators.csv_table import Table, distinct, read_table
from clast_plugins.generators.grains import connected_grains
from clast_plugins.generators.lammps_data import read_lammps
from clast_plugins.generators.particle_table import ParticleTable
from clast_plugins.generators.vtkhdf_points import read_vtkhdf

READERS = {".data": read_lammps, ".vtkhdf": read_vtkhdf}
"""How files are read, by the end of their name; all others are CSV."""


class FromFile(Params):
    """Particles from a table ``id,x,y,z,radius[,material]``, bonds from ``i,j,diameter[,initial_length]``.

    All numbers are SI, ``i`` and ``j`` are ids of particles, and paths start from the scene's folder. Where
    no initial length is given it is the distance of the centres. Particles start at rest.

    With a file of bonds, particles that bonds connect form a grain; without one, all particles are one grain.

    Files that end in ``.data`` are read as data files of LAMMPS in units ``si`` (atom style ``bpm/sphere`` or
    ``sphere``), in ``.vtkhdf`` as files of VTK, the last time in them: both as ``clast export`` writes them. They hold
    their bonds, as thick as the smaller particle and undeformed, and where they tell grains, these. Clast exports
    places in single precision: surfaces that touched may overlap by 1e-7 of their distance from the origin.
    """

    particles: Annotated[
        str,
        Field(min_length=1, description="CSV file with id,x,y,z,radius[,material] in m; or one of LAMMPS or of VTK"),
    ]
    bonds: Annotated[
        str | None,
        Field(min_length=1, description="CSV file with i,j,diameter[,initial_length] in m; none: no bonds"),
    ] = None
    material: Annotated[str | None, Field(description="Material of particles whose row names none")] = None
    materials: Annotated[
        list[str] | None,
        Field(
            min_length=1,
            description="Names of the types 1, 2, … of LAMMPS or the materials 0, 1, … of VTK, in this order",
        ),
    ] = None

    @model_validator(mode="after")
    def _where_bonds_and_materials_are(self) -> FromFile:
        reader = READERS.get(Path(self.particles).suffix)
        if reader is None and self.materials is not None:
            raise ValueError("'materials' names the numbers of LAMMPS and VTK; a CSV file has a column 'material'")
        if reader is not None and self.bonds is not None:
            raise ValueError(f"{self.particles} holds its bonds itself; leave 'bonds' out")
        return self


def read_particles(path: Path, material: str | None) -> ParticleTable:
    """Read a table of particles.

    Raises
    ------
    ConfigError
        Every problem with its line: no number, a radius not above zero, an id that comes twice, no material.
    """
    table = read_table(path, ("id", "x", "y", "z", "radius"), ("material",))
    new_id = distinct(table, "particle")
    ids: list[int] = []
    measures: list[tuple[float, float, float, float]] = []
    materials: list[str] = []
    for line, row in table.rows:
        number = table.integer(line, row, "id")
        if number is not None:
            new_id(line, number)
            ids.append(number)
        x, y, z = (table.number(line, row, axis) for axis in "xyz")
        measures.append((x, y, z, table.number(line, row, "radius", above=0.0)))
        name = row.get("material") or material
        if name is None:
            table.wrong(line, "the row names no material; add a column 'material', or 'material' to the scene")
        materials.append(name or "")
    table.refuse_problems()
    found = np.array(measures)
    lines = [line for line, _ in table.rows]
    return ParticleTable(ids, found[:, :3].copy(), found[:, 3].copy(), materials, lambda k: f"{path}:{lines[k]}")


def read_bonds(path: Path, particles: ParticleTable) -> BondList:
    """Read a table of bonds between particles named by their ids.

    Raises
    ------
    ConfigError
        Every problem with its line: no number, a missing particle, a bond without length.
    """
    table = read_table(path, ("i", "j", "diameter"), ("initial_length",))
    index = {number: at for at, number in enumerate(particles.ids)}
    ends: list[tuple[int, int]] = []
    measures: list[tuple[float, float]] = []
    for line, row in table.rows:
        i, j = (_end(table, line, row, column, index) for column in ("i", "j"))
        diameter = table.number(line, row, "diameter", above=0.0)
        given = bool(row.get("initial_length"))
        length = table.number(line, row, "initial_length", above=0.0) if given else math.nan
        measures.append((diameter, length))
        if i is None or j is None:
            continue
        ends.append((i, j))
        if i != j and np.array_equal(particles.position[i], particles.position[j]):
            table.wrong(line, f"particles {row['i']} and {row['j']} have one centre, so their bond has no direction")
    table.refuse_problems()
    found, lines = np.array(measures), [line for line, _ in table.rows]
    pairs = np.array(ends, np.int64)
    return BondList(pairs, found[:, 0].copy(), found[:, 1].copy(), origin=lambda k: f"{path}:{lines[k]}")


def _end(table: Table, line: int, row: dict[str, str], column: str, index: dict[int, int]) -> int | None:
    number = table.integer(line, row, column)
    if number is not None and number not in index:
        table.wrong(line, f"{column} names particle {number}, which the table of particles does not hold")
    return None if number is None else index.get(number)


def read(params: FromFile, site: Site) -> tuple[ParticleTable, BondList | None]:
    """Read particles and bonds.

    Raises
    ------
    ConfigError
        Anything wrong with a file.
    """
    path = site.folder / params.particles
    reader = READERS.get(path.suffix)
    if reader is not None:
        with about("particles"):
            return reader(path, params.material, params.materials)
    with about("particles"):
        particles = read_particles(path, params.material)
    if params.bonds is None:
        return particles, None
    with about("bonds"):
        return particles, read_bonds(site.folder / params.bonds, particles)


def generate(params: FromFile, site: Site) -> Packing:
    """Read the particles and bonds.

    Raises
    ------
    ConfigError
        Anything wrong with a file.
    """
    particles, bonds = read(params, site)
    count = len(particles.ids)
    return Packing(
        position=particles.position,
        radius=particles.radius,
        material=particles.material,
        velocity=np.zeros((count, 3)),
        spin=np.zeros((count, 3)),
        prescribed=np.zeros(count, np.bool_),
        grain=_grains(particles, bonds),
        bonds=bonds,
        report={
            "particles": count,
            "bonds_read": 0 if bonds is None else len(bonds.ends),
            "particles_file": params.particles,
            **({} if params.bonds is None else {"bonds_file": params.bonds}),
        },
        origin=particles.origin,
    )


def _grains(particles: ParticleTable, bonds: BondList | None) -> NDArray[np.int64]:
    if particles.grain is not None:
        return particles.grain
    count = len(particles.ids)
    return np.zeros(count, np.int64) if bonds is None else connected_grains(count, bonds.ends)


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer particles and bonds from files."""
    registry.generator(
        "from_file",
        Generator(
            summary="particles and bonds read from CSV tables, or from files of LAMMPS or VTK",
            Params=FromFile,
            generate=generate,
        ),
    )
