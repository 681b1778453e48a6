"""Opening the files of a run folder, with a plain sentence for everything that can be wrong with them."""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

from clast.errors import ClastError, DamagedError, RefusedError, one_line

RESULTS_FILE = "results.h5"
CONFIG_FILE = "config.yaml"
SCHEMA = 1
_NEEDED_GROUPS = ("particles", "bonds", "curves", "cracks")


def open_results(folder: Path) -> Any:
    """Open ``results.h5`` of a run folder for reading."""
    import h5py

    path = folder / RESULTS_FILE
    if not folder.is_dir():
        what = "a file, not a folder" if folder.exists() else "not there"
        raise RefusedError(f"{folder}: {what}; give the run folder, the one that holds {RESULTS_FILE}")
    if not path.is_file():
        raise RefusedError(f"{folder}: not a run folder, it holds no {RESULTS_FILE}; start with `clast run FILE`")
    try:
        return h5py.File(path, "r")
    except BlockingIOError as error:
        raise _busy(path) from error
    except PermissionError as error:
        raise RefusedError(f"{path}: no permission to read it") from error
    except (OSError, RuntimeError) as error:
        raise unreadable(path, one_line(error)) from error


@contextmanager
def telling_damage(path: Path, where: str = "") -> Iterator[None]:
    """Turn whatever a file raises that is not what it should be into one sentence: h5py raises nearly anything."""
    try:
        yield
    except ClastError:
        raise
    except Exception as error:
        raise unreadable(path, f"{where}{one_line(error)}") from error


def check_contents(path: Path, file: Any) -> None:
    """Raise RunError unless the file holds results this version can read."""
    schema = file.attrs.get("schema")
    if schema is None:
        raise unreadable(path, "it was not written by Clast: no `schema` attribute")
    if int(schema) != SCHEMA:
        raise RefusedError(f"{path}: written in schema {schema}, this version of Clast reads {SCHEMA}; run it again")
    missing = [name for name in _NEEDED_GROUPS if name not in file]
    if missing:
        raise unreadable(path, f"it holds no {', '.join(missing)}")


def _busy(path: Path) -> RefusedError:
    return RefusedError(
        f"{path}: a running simulation is writing it; wait until it has ended, "
        "or stop it with Ctrl-C (it can be resumed)"
    )


def unreadable(path: Path, reason: str) -> DamagedError:
    """Build the error for a damaged file."""
    return DamagedError(f"{path}: cannot be read ({reason}); the file is damaged or cut short, run the scene again")


def common_length(group: Any) -> dict[str, NDArray[Any]]:
    """Read all columns of a group, cut to the shortest: a killed run may have written half a row."""
    length = min((len(dataset) for dataset in group.values()), default=0)
    return {name: dataset[:length] for name, dataset in group.items()}


def strings(values: Any) -> list[str]:
    """Read an attribute that lists names."""
    return [value.decode() if isinstance(value, bytes) else str(value) for value in values]


def read_json(path: Path) -> dict[str, Any]:
    """Read a JSON file, or nothing where it does not exist yet."""
    if not path.is_file():
        return {}
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise RefusedError(f"{path}: cannot be read ({one_line(error)})") from error
    return content if isinstance(content, dict) else {}


def read_yaml(path: Path) -> dict[str, Any]:
    """Read a YAML file, or nothing where it does not exist."""
    import yaml

    if not path.is_file():
        return {}
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise RefusedError(f"{path}: cannot be read ({one_line(error)})") from error
    return content if isinstance(content, dict) else {}
