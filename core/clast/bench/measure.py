"""Measuring: processes of their own, their CPU seconds and peak memory, and the spread of repeats."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

from clast.errors import ClastError

LAUNCHER = Path(__file__).with_name("launch.py")
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}


class BenchmarkError(ClastError):
    """A command that was to be measured failed."""


@dataclass(frozen=True)
class Child:
    """A finished process: CPU time (user and system, with its children) and wall time in s, peak memory in MB."""

    cpu: float
    wall: float
    memory: float
    launched_at: float
    output: str


class Spread(NamedTuple):
    """Median, smallest and largest of some measurements."""

    median: float
    low: float
    high: float

    def __str__(self) -> str:
        """Say it as in the tables.

        >>> str(Spread(1234.0, 1200.5, 1300.0)), str(Spread(0.123, 0.12, 0.13))
        ('1 234 (1 200 to 1 300)', '0.12 (0.12 to 0.13)')
        """
        middle = number(self.median)
        return middle if self.low == self.high else f"{middle} ({number(self.low)} to {number(self.high)})"


def spread(values: Sequence[float]) -> Spread:
    """Return the median and the range of some values."""
    return Spread(float(median(values)), float(min(values)), float(max(values)))


def number(value: float) -> str:
    """Write a number with two or three digits, thousands apart.

    >>> number(12345.6), number(54.53), number(5.312), number(0.0456)
    ('12 346', '54.5', '5.3', '0.05')
    """
    size = abs(value)
    if size >= 100:
        return f"{value:,.0f}".replace(",", " ")
    return f"{value:.1f}" if size >= 1 else f"{value:.2f}"


def run_child(
    command: Sequence[str], folder: Path | None = None, environment: Mapping[str, str] | None = None
) -> Child:
    """Run a command on one thread and wait for it.

    Raises
    ------
    BenchmarkError
        If it does not start or fails; with the end of what it printed.
    """
    around = {**os.environ, **ONE_THREAD, **(environment or {})}
    with tempfile.TemporaryDirectory() as place:
        report, printed = Path(place) / "report.json", Path(place) / "printed"
        with printed.open("w") as output:
            launcher = [sys.executable, "-S", str(LAUNCHER), str(report), *command]
            ended = subprocess.run(launcher, cwd=folder, env=around, stdout=output, stderr=subprocess.STDOUT)
        told = printed.read_text()
        if ended.returncode:
            raise BenchmarkError(f"{' '.join(command)} failed ({ended.returncode}):\n{told[-1500:]}")
        return Child(**json.loads(report.read_text()), output=told)


def worker(task: str, *arguments: object, environment: Mapping[str, str] | None = None) -> tuple[Child, Any]:
    """Run a task of :mod:`clast.bench.worker` in a process of its own; return it and what it measured."""
    command = [sys.executable, "-m", "clast.bench.worker", task, *map(str, arguments)]
    child = run_child(command, None, environment)
    return child, json.loads(child.output.strip().splitlines()[-1])


def clast(*arguments: object, environment: Mapping[str, str] | None = None) -> Child:
    """Run the ``clast`` command of this environment."""
    program = Path(sys.executable).parent / "clast"
    return run_child([str(program), *map(str, arguments)], None, environment)


def say(text: str) -> None:
    """Tell how far the benchmark is."""
    print(text, flush=True)
