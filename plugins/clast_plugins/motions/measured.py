"""A measured course in a file: times, and displacements or velocities, with units in the header."""

from __future__ import annotations

import re
from pathlib import Path

from clast.config.quantities import to_si
from clast.errors import ConfigError
from clast_plugins.generators.csv_table import Table, split, text_lines

UNITS = {"time": "s", "displacement": "m", "velocity": "m/s"}
HEADER = "time [s],displacement [mm]"
COLUMN = re.compile(r"(time|displacement|velocity)(?: *\[(.+)\]| *\((.+)\)|_(.+))")

Rows = tuple[tuple[float, float], ...]


def read_course(path: Path) -> tuple[str, Rows]:
    """Return ``displacement`` or ``velocity``, whichever a file holds, and its rows of time and value in SI.

    Raises
    ------
    ConfigError
        With file and line: the file cannot be read, the header lacks a column or a unit, or a cell holds no number.
    """
    table = split(path, text_lines(path, f"a CSV file with a header such as '{HEADER}'"))
    columns = _columns(table)
    found = [name for name in ("displacement", "velocity") if name in columns]
    if "time" not in columns or len(found) != 1:
        told = ", ".join(columns) or "none of them"
        needed = f"a time and either a displacement or a velocity are needed, each with its unit, as in '{HEADER}'"
        raise ConfigError(f"{path}:1: the header holds {told}; {needed}", at=None)
    wanted = ("time", found[0])
    rows = tuple((_cell(table, columns, "time", k), _cell(table, columns, found[0], k)) for k in range(len(table.rows)))
    table.refuse_problems()
    assert all(name in columns for name in wanted)
    return found[0], rows


def _columns(table: Table) -> dict[str, tuple[str, float]]:
    """Return the columns of known names: how the header writes each, and its unit in SI."""
    found: dict[str, tuple[str, float]] = {}
    for written in table.columns:
        match = COLUMN.fullmatch(written)
        if match is None:
            continue
        unit = next(each for each in match.groups()[1:] if each)
        try:
            found[match[1]] = (written, to_si(f"1 {unit}", UNITS[match[1]]))
        except ValueError as error:
            raise ConfigError(f"{table.path}:1: column {written!r}: {error}", at=None) from None
    return found


def _cell(table: Table, columns: dict[str, tuple[str, float]], name: str, row: int) -> float:
    written, unit = columns[name]
    line, cells = table.rows[row]
    if written not in cells:
        table.wrong(line, f"{written} is missing")
        return 0.0
    return unit * table.number(line, cells, written)
