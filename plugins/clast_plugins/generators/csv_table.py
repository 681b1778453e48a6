"""Reading a table of comma-separated values so that everything wrong with it is told with its line."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from clast.errors import ConfigError
from clast.plugins.nearest import suggestion

MOST_TOLD = 20


@dataclass
class Table:
    """Rows of a file as text, and the problems found so far.

    Attributes
    ----------
    path : Path
        The file.
    columns : list of str
        Names in the header, in the file's order.
    rows : list of (line number, {column: text})
    problems : list of (line number, sentence)
    """

    path: Path
    columns: list[str]
    rows: list[tuple[int, dict[str, str]]]
    problems: list[tuple[int, str]] = field(default_factory=list)

    def wrong(self, line: int, sentence: str) -> None:
        """Note a problem; ``refuse_problems`` tells them all."""
        self.problems.append((line, sentence))

    def refuse_problems(self) -> None:
        """Raise one ConfigError with every problem noted, if there is any.

        Raises
        ------
        ConfigError
            One line ``file:line: problem`` each; the first 20.
        """
        if not self.problems:
            return
        told = [f"{self.path}:{line}: {sentence}" for line, sentence in sorted(self.problems)[:MOST_TOLD]]
        if len(self.problems) > MOST_TOLD:
            told.append(f"{self.path}: and {len(self.problems) - MOST_TOLD} more problems")
        raise ConfigError("\n".join(told), at=None)

    def number(self, line: int, row: dict[str, str], column: str, above: float = -math.inf) -> float:
        """Return a cell as a finite number above a bound; on a problem note it and return nan."""
        text = row[column]
        try:
            value = float(text)
        except ValueError:
            self.wrong(line, f"{column} is {text!r}, not a number; write plain SI numbers such as 0.000125")
            return math.nan
        if not math.isfinite(value):
            self.wrong(line, f"{column} is {text!r}; a finite number is needed")
            return math.nan
        if value <= above:
            self.wrong(line, f"{column} is {text}; it must be above {above:g}")
            return math.nan
        return value

    def integer(self, line: int, row: dict[str, str], column: str) -> int | None:
        """Return a cell as an integer; on a problem note it and return None."""
        try:
            return int(row[column])
        except ValueError:
            self.wrong(line, f"{column} is {row[column]!r}, not an integer")
            return None


def read_table(path: Path, required: Sequence[str], optional: Sequence[str]) -> Table:
    """Read a file with a header line.

    Parameters
    ----------
    path : Path
    required, optional : sequence of str
        Columns that must, and that may be there, in any order.

    Raises
    ------
    ConfigError
        The file is missing, unreadable, empty, no text, or its header or a row's length is wrong.
    """
    table = split(path, text_lines(path, f"a CSV file with the header '{','.join(required)}'"))
    _check_header(table, required, optional)
    for line, row in table.rows:
        if "" in row.values() or len(row) != len(table.columns):
            _check_row(table, line, row, set(optional))
    table.refuse_problems()
    if not table.rows:
        raise ConfigError(f"{path}: holds a header but no rows; give at least one")
    return table


def text_lines(path: Path, needed: str) -> list[str]:
    """Return the lines of a text file; ``needed`` says in messages what it should be.

    Raises
    ------
    ConfigError
        The file is missing, unreadable, empty or no text.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        beside = [p.name for p in path.parent.glob("*")] if path.parent.is_dir() else []
        hint = f" ({suggestion(path.name, beside)})" if 0 < len(beside) < 50 else ""
        raise ConfigError(f"{path}: there is no such file{hint}; check the path") from None
    except UnicodeDecodeError as error:
        raise ConfigError(f"{path}: not a text file (byte {error.start} is no UTF-8); {needed} is needed") from None
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror or error}") from None
    if not text.strip():
        raise ConfigError(f"{path}: the file is empty; {needed} is needed")
    return text.splitlines()


def split(path: Path, lines: list[str]) -> Table:
    """Return the cells of lines, the first of which that is not empty names the columns.

    Raises
    ------
    ConfigError
        A quote is not closed, or columns are separated by semicolons.
    """
    columns: list[str] = []
    table = Table(path, columns, [])
    reader = csv.reader(lines, strict=True)
    while True:
        try:
            cells = [cell.strip() for cell in next(reader)]
        except StopIteration:
            return table
        except csv.Error as error:
            raise ConfigError(f"{path}:{reader.line_num}: not readable as CSV: {error}", at=None) from None
        if not any(cells):
            continue
        if not columns:
            columns += cells
            if len(cells) == 1 and ";" in cells[0]:
                raise ConfigError(
                    f"{path}:{reader.line_num}: columns are separated by ';'; they must be separated by commas", at=None
                )
        elif len(cells) > len(columns):
            table.wrong(reader.line_num, f"{len(cells)} values for {len(columns)} columns ({','.join(columns)})")
        else:
            table.rows.append((reader.line_num, dict(zip(columns, cells, strict=False))))


def _check_header(table: Table, required: Sequence[str], optional: Sequence[str]) -> None:
    line = 1
    form = ",".join(required) + "".join(f"[,{name}]" for name in optional)
    known = {*required, *optional}
    for name in table.columns:
        if name not in known:
            table.wrong(line, f"column {name!r} is not known; {suggestion(name, known)}; the header is '{form}'")
        elif table.columns.count(name) > 1 and f"column {name!r} stands twice" not in dict(table.problems).values():
            table.wrong(line, f"column {name!r} stands twice")
    for name in required:
        if name not in table.columns:
            table.wrong(line, f"column {name!r} is missing; the header is '{form}', separated by commas")
    if any(problem_line == line for problem_line, _ in table.problems):
        table.problems = [problem for problem in table.problems if problem[0] == line]
        table.refuse_problems()


def _check_row(table: Table, line: int, row: dict[str, str], optional: set[str]) -> None:
    if len(row) < len(table.columns) and any(name not in optional for name in table.columns[len(row) :]):
        table.wrong(line, f"{len(row)} values for {len(table.columns)} columns ({','.join(table.columns)})")
        return
    for name, text in row.items():
        if not text and name not in optional:
            table.wrong(line, f"{name} is empty")


def distinct(table: Table, what: str) -> Callable[[int, object], None]:
    """Return a function that notes a problem when a key comes a second time, naming the first line."""
    seen: dict[object, int] = {}

    def check(line: int, key: object) -> None:
        first = seen.setdefault(key, line)
        if first != line:
            table.wrong(line, f"{what} {key} is there already, in line {first}; remove one of them")

    return check
