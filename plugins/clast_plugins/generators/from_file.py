"""From file: particles and bonds read from CSV tables."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from clast import hookimpl
from clast.errors import about
from clast.parts.generator import BondList, Generator, Packing, Site
from clast.parts.params import Params
from clast.plugins.registry import Registry
from clast_plugins.generators.csv_table import Table, distinct, read_table
from clast_plugins.generators.grains import connected_grains


class FromFile(Params):
    """Particles from a table ``id,x,y,z,radius[,material]``, bonds from ``i,j,diameter[,initial_length]``.

    All numbers are SI, ``i`` and ``j`` are ids of particles, and paths start from the scene's folder. Where
    no initial length is given it is the distance of the centres. Particles start at rest.

    With a file of bonds, particles that bonds connect form a grain; without one, all particles are one grain.
    """

    particles: Annotated[str, Field(min_length=1, description="CSV file with id,x,y,z,radius[,material] in m")]
    bonds: Annotated[
        str | None,
        Field(min_length=1, description="CSV file with i,j,diameter[,initial_length] in m; none: no bonds"),
    ] = None
    material: Annotated[str | None, Field(description="Material of particles whose row names none")] = None


class ParticleTable(NamedTuple):
    """Particles as read: lines in the file, ids, ``(n, 3)`` centres and ``(n,)`` radii in m, materials."""

    lines: list[int]
    ids: list[int]
    position: NDArray[np.float64]
    radius: NDArray[np.float64]
    material: list[str]


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
    return ParticleTable([line for line, _ in table.rows], ids, found[:, :3].copy(), found[:, 3].copy(), materials)


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
    """Read both tables.

    Raises
    ------
    ConfigError
        Anything wrong with either file.
    """
    with about("particles"):
        particles = read_particles(site.folder / params.particles, params.material)
    if params.bonds is None:
        return particles, None
    with about("bonds"):
        return particles, read_bonds(site.folder / params.bonds, particles)


def generate(params: FromFile, site: Site) -> Packing:
    """Read the particles and bonds.

    Raises
    ------
    ConfigError
        Anything wrong with either file.
    """
    particles, bonds = read(params, site)
    count, lines = len(particles.ids), particles.lines
    return Packing(
        position=particles.position,
        radius=particles.radius,
        material=particles.material,
        velocity=np.zeros((count, 3)),
        spin=np.zeros((count, 3)),
        prescribed=np.zeros(count, np.bool_),
        grain=np.zeros(count, np.int64) if bonds is None else connected_grains(count, bonds.ends),
        bonds=bonds,
        report={
            "particles": count,
            "bonds_read": 0 if bonds is None else len(bonds.ends),
            "particles_file": params.particles,
            **({} if params.bonds is None else {"bonds_file": params.bonds}),
        },
        origin=lambda k: f"{site.folder / params.particles}:{lines[k]}",
    )


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer particles and bonds from files."""
    registry.generator(
        "from_file",
        Generator(
            summary="particles and bonds read from CSV tables",
            Params=FromFile,
            generate=generate,
        ),
    )
