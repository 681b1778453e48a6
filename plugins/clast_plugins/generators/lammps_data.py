"""Reading a data file of LAMMPS, as ``clast export --to lammps`` writes it.

Source: https://docs.lammps.org/read_data.html
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from clast.errors import ConfigError
from clast.parts.generator import BondList
from clast_plugins.generators.csv_table import Table, distinct, text_lines
from clast_plugins.generators.particle_table import (
    ParticleTable,
    bonds_between,
    named_materials,
    numbered_from_zero,
)

NEEDED = "a data file of LAMMPS with the section 'Atoms # bpm/sphere' or 'Atoms # sphere'"
ATOMS = {
    "bpm/sphere": ["id", "molecule", "type", "diameter", "density", "x", "y", "z"],
    "sphere": ["id", "type", "diameter", "density", "x", "y", "z"],
}
"""Columns of each atom style; three image flags may follow, which only count periods."""
BONDS = ["id", "type", "i", "j"]
IMAGE_FLAGS = 3


class Section(NamedTuple):
    """Part of a data file: what follows its name after a ``#``, its line, and its rows as (line number, cells)."""

    hint: str
    line: int
    rows: list[tuple[int, list[str]]]


def read_lammps(path: Path, material: str | None, materials: list[str] | None) -> tuple[ParticleTable, BondList | None]:
    """Read particles and the bonds between them.

    Raises
    ------
    ConfigError
        Every problem with its line; no known atom style; another number of atoms or bonds than the header tells.
    """
    header, sections = split(path)
    particles = _particles(path, sections, material, materials)
    bonds = _bonds(path, sections["Bonds"], particles) if "Bonds" in sections else None
    for name, found in (("atoms", len(particles.ids)), ("bonds", 0 if bonds is None else len(bonds.ends))):
        if name in header and header[name] != found:
            raise ConfigError(f"{path}: its header tells {header[name]} {name}, and it holds {found}; is it cut off?")
    return particles, bonds


def split(path: Path) -> tuple[dict[str, int], dict[str, Section]]:
    """Return the counts of the header and the sections by name; the first line is a comment.

    Raises
    ------
    ConfigError
        The file is missing, unreadable, empty or no text.
    """
    header: dict[str, int] = {}
    sections: dict[str, Section] = {}
    rows: list[tuple[int, list[str]]] | None = None
    for line, text in enumerate(text_lines(path, NEEDED), start=1):
        told, _, comment = text.partition("#")
        if line == 1 or not told.strip():
            continue
        if re.fullmatch(r"[A-Z][A-Za-z ]*", told.strip()):
            rows = []
            sections[told.strip()] = Section(comment.strip(), line, rows)
        elif rows is not None:
            rows.append((line, told.split()))
        elif count := re.fullmatch(r"(\d+) (atoms|bonds)", told.strip()):
            header[count[2]] = int(count[1])
    return header, sections


def _particles(
    path: Path, sections: dict[str, Section], material: str | None, materials: list[str] | None
) -> ParticleTable:
    if "Atoms" not in sections or not sections["Atoms"].rows:
        raise ConfigError(f"{path}: holds no atoms; {NEEDED} is needed")
    atoms = sections["Atoms"]
    if atoms.hint not in ATOMS:
        told = f"the atom style {atoms.hint!r}" if atoms.hint else "no atom style"
        raise ConfigError(f"{path}:{atoms.line}: {told} after 'Atoms #'; {' or '.join(ATOMS)} is needed", at=None)
    table = _table(path, atoms, ATOMS[atoms.hint], IMAGE_FLAGS)
    new_id = distinct(table, "particle")
    ids, kinds, measures, grains = [], [], [], []
    for line, row in table.rows:
        number, kind = table.integer(line, row, "id"), table.integer(line, row, "type")
        molecule = table.integer(line, row, "molecule") if "molecule" in row else 1
        diameter = table.number(line, row, "diameter", above=0.0)
        measures.append((*(table.number(line, row, axis) for axis in "xyz"), 0.5 * diameter))
        if number is None or kind is None or molecule is None:
            continue
        new_id(line, number)
        ids.append(number)
        kinds.append(kind)
        grains.append(max(molecule, 0) - 1)
    table.refuse_problems()
    found, lines = np.array(measures), [line for line, _ in table.rows]
    return ParticleTable(
        ids,
        found[:, :3].copy(),
        found[:, 3].copy(),
        named_materials(path, kinds, 1, material, materials),
        lambda k: f"{path}:{lines[k]}",
        numbered_from_zero(np.array(grains, np.int64)),
    )


def _bonds(path: Path, section: Section, particles: ParticleTable) -> BondList:
    table = _table(path, section, BONDS, 0)
    index = {number: at for at, number in enumerate(particles.ids)}
    ends = []
    for line, row in table.rows:
        i, j = (table.integer(line, row, end) for end in "ij")
        for number in (i, j):
            if number is not None and number not in index:
                table.wrong(line, f"the bond names atom {number}, which the file does not hold")
        if i in index and j in index and i is not None and j is not None:
            ends.append((index[i], index[j]))
    table.refuse_problems()
    lines = [line for line, _ in table.rows]
    return bonds_between(particles, np.array(ends, np.int64).reshape(-1, 2), lambda k: f"{path}:{lines[k]}")


def _table(path: Path, section: Section, columns: list[str], spare: int) -> Table:
    """Return the rows of a section by column.

    Raises
    ------
    ConfigError
        Rows with another number of values.
    """
    table = Table(path, columns, [])
    for line, cells in section.rows:
        if len(cells) not in (len(columns), len(columns) + spare):
            table.wrong(line, f"{len(cells)} values for {len(columns)} columns ({' '.join(columns)})")
        else:
            table.rows.append((line, dict(zip(columns, cells, strict=False))))
    table.refuse_problems()
    return table
