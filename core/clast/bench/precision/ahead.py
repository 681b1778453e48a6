"""Compiling the loops of a sweep beforehand, on two processors."""

from __future__ import annotations

import yaml

from clast.bench.features import compile_all
from clast.bench.measure import BenchmarkError, say
from clast.bench.precision.problem import Problem
from clast.bench.section import Task
from clast.errors import ClastError


def compile_ahead(problem: Problem, task: Task) -> None:
    """Compile one loop for every way; what cannot be compiled is told by the sweep."""
    files = []
    for k, way in enumerate(problem.ways(task.registry.names)):
        try:
            scene = problem.scene(1, task.files).changed(problem.changes(way, problem.steps[-1]))
        except ClastError:
            continue
        file = task.folder / f"{problem.name}-{k}.yaml"
        file.write_text(yaml.safe_dump(scene.resolved(), sort_keys=False))
        files.append(file)
    say(f"{problem.name}: compiling {len(files)} loops where they are not on disk yet")
    try:
        compile_all(files)
    except BenchmarkError as error:
        say(str(error))
