"""Record: the account of a calibration as data, for programs that show it."""

from __future__ import annotations

from pathlib import Path

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator

from clast.errors import RefusedError
from clast.results.whole_file import whole_file


class Grid(BaseModel):
    """A table: its heads, and rows of as many cells."""

    model_config = ConfigDict(frozen=True)

    heads: list[str]
    rows: list[list[str]]

    @model_validator(mode="after")
    def _rectangular(self) -> Grid:
        if any(len(row) != len(self.heads) for row in self.rows):
            raise ValueError("rows need as many cells as there are heads")
        return self


class Record(BaseModel):
    """What a calibration found, in words and tables.

    Attributes
    ----------
    name, description : str
        As the calibration file has them.
    points, repeats, runs, failed : int
        Points of the parameter space, runs a point, runs in all, and how many of these failed.
    best : int
        Number of the point that was chosen.
    parameters, targets, sensitivities : Grid
    distances : list of float
        Of the targets, in the order of their table: how far they are expected to be off, in tolerances.
    left_open : list of str
        Sentences on what the targets do not determine.
    """

    model_config = ConfigDict(frozen=True, allow_inf_nan=False)

    name: str
    description: str
    points: int
    repeats: int
    runs: int
    failed: int
    best: int
    parameters: Grid
    targets: Grid
    sensitivities: Grid
    distances: list[float]
    left_open: list[str]

    @model_validator(mode="after")
    def _a_distance_each(self) -> Record:
        if len(self.distances) != len(self.targets.rows):
            raise ValueError("every target needs one distance")
        return self


def write_record(record: Record, path: Path) -> None:
    """Write a record as JSON."""
    with whole_file(path) as draft:
        draft.write_text(record.model_dump_json(indent=2) + "\n", encoding="utf-8")


def read_record(path: Path) -> Record:
    """Read a record.

    Raises
    ------
    RunError
        If it is not what a calibration writes.
    """
    try:
        return Record.model_validate_json(path.read_bytes())
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        reason = f"{place}: {first['msg']}" if place else first["msg"]
        raise RefusedError(
            f"{path}: cannot be read ({reason}); run `clast calibrate` again, which writes it anew"
        ) from error
