"""``clast write``: make the files of a run anew."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from clast.config.scene import load
from clast.errors import ConfigError, RefusedError, RunError
from clast.results.reading import CONFIG_FILE
from clast.results.run import open_run
from clast.writing import launch
from clast.writing.process import chosen_writers

CHANGEABLE = "output.writers"


def write(folder: Path, names: Sequence[str] = (), overrides: Sequence[str] = ()) -> None:
    """Let the writers that a run's scene names write, or the ones named here; print the path of every file.

    Raises
    ------
    ClastError
        If the folder holds no finished run, there is no such writer, one wrote nothing, or an override is wrong or
        changes something else than writers.
    """
    for override in overrides:
        if not override.startswith(CHANGEABLE):
            raise ConfigError(
                f"--set {override}: the run has ended; only what its writers draw, {CHANGEABLE}…, can change"
            )
    with open_run(folder):
        scene = load(folder / CONFIG_FILE, overrides)
    names = [chosen.name for chosen in chosen_writers(scene, names)] or [each.name for each in scene.output.writers]
    if not names:
        known = ", ".join(scene.registry.names("writer"))
        raise RefusedError(f"{folder}: its scene names no writer; name one or several: {known}")
    written = launch.write(folder, names, lambda name: print(f"writing {name}", flush=True), overrides)
    for outcome in written.values():
        if outcome.path is not None:
            print(f"  {outcome.path}")
    missing = [f"no {name}: {outcome.skipped}" for name, outcome in written.items() if outcome.path is None]
    if missing:
        raise RunError("\n".join(missing))
