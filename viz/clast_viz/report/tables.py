"""Tables: CSV files that a command leaves in its folder, read back with their heads checked."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path

from clast.errors import RefusedError, one_line

Record = dict[str, str]


def read_table(path: Path, needed: Sequence[str], command: str) -> list[Record]:
    """Read a table; nothing where there is none.

    Parameters
    ----------
    path : Path
    needed : sequence of str
        Columns without which it is not the table that is meant.
    command : str
        What writes it, for the message.

    Raises
    ------
    RunError
        If it is not what the command writes.
    """
    if not path.is_file():
        return []
    try:
        with path.open(newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file, restval="")
            missing = [name for name in needed if name not in (reader.fieldnames or [])]
            rows = [{key: value for key, value in row.items() if key is not None} for row in reader]
    except (UnicodeDecodeError, csv.Error) as error:
        raise unreadable(path, one_line(error), command) from error
    if missing:
        raise unreadable(path, f"it has no column {', '.join(missing)}", command)
    return rows


def unreadable(path: Path, reason: str, command: str) -> RefusedError:
    """Build the error for a file that is not what a command writes."""
    return RefusedError(f"{path}: cannot be read ({reason}); run `{command}` again, which writes it anew")
