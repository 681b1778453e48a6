"""Measured results as JSON, so that the page can be written again without measuring."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter, ValidationError

from clast.bench.machine import Machine
from clast.bench.section import Section
from clast.errors import ConfigError


@dataclass(frozen=True)
class Record:
    """One section's result and where it comes from; ``problem`` says why there is none."""

    section: str
    command: str
    effort: str
    machine: Machine
    seconds: float
    result: Any = None
    problem: str = ""


def keep(folder: Path, section: Section, record: Record) -> None:
    """Write a section's record."""
    folder.mkdir(parents=True, exist_ok=True)
    plain = TypeAdapter(Record).dump_python(record, mode="json")
    if record.result is not None:
        plain["result"] = TypeAdapter(section.Result).dump_python(record.result, mode="json")
    (folder / f"{section.name}.json").write_text(json.dumps(plain, indent=1, ensure_ascii=False) + "\n")


def find(folder: Path, section: Section) -> Record | None:
    """Return a section's record; None where it was never measured.

    Raises
    ------
    ConfigError
        The file holds something else.
    """
    file = folder / f"{section.name}.json"
    if not file.exists():
        return None
    try:
        record = TypeAdapter(Record).validate_json(file.read_bytes())
        if record.result is None:
            return record
        result = TypeAdapter(section.Result).validate_python(record.result)
    except ValidationError as error:
        what = error.errors()[0]
        place = ".".join(str(each) for each in what["loc"])
        raise ConfigError(f"{file}: {place}: {what['msg']}; measure again: clast bench --only {section.name}") from None
    return Record(**{**record.__dict__, "result": result})
