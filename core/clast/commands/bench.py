"""``clast bench``: measure, keep what was measured, and write the page."""

from __future__ import annotations

import tempfile
import time
import traceback
from collections.abc import Sequence
from pathlib import Path

from clast.bench import machine, peer, store
from clast.bench.measure import say
from clast.bench.page import page
from clast.bench.section import Effort, Section, Task
from clast.bench.store import Record
from clast.bench.suite import SECTIONS
from clast.errors import ClastError, RunError
from clast.plugins.discovery import discover

NO_PEER = "LAMMPS was not asked for (`--peer lammps`)."


def bench(
    sections: Sequence[Section], effort: Effort, peer_name: str, files: tuple[Path, ...], command: str, output: Path
) -> bool:
    """Measure sections one after the other and write the page; tell whether all could be measured."""
    registry = discover(files)
    found, problem = peer.install() if peer_name == "lammps" else (None, NO_PEER)
    if peer_name == "lammps" and found is None:
        say(problem)
    begun, whole = time.perf_counter(), True
    with tempfile.TemporaryDirectory(prefix="clast-benchmark-") as folder:
        task = Task(effort, registry, files, found, problem, Path(folder))
        for section in sections:
            say(f"== {section.name}: {section.title}")
            record = measured(section, task, command)
            whole = whole and not record.problem
            store.keep(results(output), section, record)
            render(output)
    say(f"wrote {output} after {time.perf_counter() - begun:.0f} s")
    return whole


def measured(section: Section, task: Task, command: str) -> Record:
    """Measure one section; what goes wrong is its result, so that the others go on."""
    here, begun = machine.describe(), time.perf_counter()
    result, problem = None, ""
    try:
        result = section.measure(task)
    except ClastError as error:
        problem = str(error)
    except Exception as error:
        traceback.print_exc()
        problem = f"{type(error).__name__}: {error}"
    if problem:
        say(f"{section.name}: {problem}")
    return Record(section.name, command, task.effort.value, here, time.perf_counter() - begun, result, problem)


def render(output: Path) -> None:
    """Write the page from what was measured, now or before.

    Raises
    ------
    RunError
        It cannot be written.
    """
    found = [(section, store.find(results(output), section)) for section in SECTIONS]
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        pictures = output.parent / "img"
        output.write_text(page([(section, record) for section, record in found if record is not None], pictures))
    except OSError as error:
        raise RunError(f"{output}: cannot be written ({error.strerror})") from error


def results(output: Path) -> Path:
    """Return the folder of the stored results, beside the page."""
    return output.with_suffix("")
