"""Checkpoints: everything a run needs to go on as if it had never stopped."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.config.scene import SceneConfig
from clast.engine.cache_lines import on_line, on_lines
from clast.engine.parts_used import changed, parts_of
from clast.engine.timeline import Timeline
from clast.errors import RefusedError, RunError, one_line
from clast.results.room import in_memory
from clast.simulation import Simulation
from clast.soundness.energy import Balance

FILE = "checkpoint.h5"
PREVIOUS = "checkpoint.previous.h5"
DERIVED = ("numbers", "scratch")
MAY_DIFFER = ("output.checkpoint", "output.writers", "reference", "description", "time.end", "time.wall_time")


def save(folder: Path, simulation: Simulation, notes: Mapping[str, Any]) -> Path:
    """Write the state of a run; the file appears whole or not at all, and the one before is kept.

    Parameters
    ----------
    folder : Path
        Run folder.
    simulation : Simulation
    notes : mapping
        JSON values to store beside the state.

    Raises
    ------
    RunError
        If the disk refuses; the last good checkpoint stays.
    """
    path, draft = folder / FILE, folder / f"{FILE}.tmp"
    try:
        draft.write_bytes(in_memory(lambda file: _fill(file, simulation, notes)))
        _settle(draft)
        if path.exists():
            path.replace(folder / PREVIOUS)
        draft.replace(path)
    except OSError as error:
        draft.unlink(missing_ok=True)
        raise RunError(f"{path}: cannot be written ({error.strerror}); {how_to_go_on(folder)}") from error
    return path


def exists(folder: Path) -> bool:
    """Tell whether a run folder has a checkpoint, good or not."""
    return any((folder / name).exists() for name in (FILE, PREVIOUS))


def how_to_go_on(folder: Path) -> str:
    """Return what to do when the disk took no more."""
    if exists(folder):
        return "the last checkpoint is kept: make room and go on with --resume"
    return "the run has no checkpoint yet: make room and start it again"


def _fill(file: Any, simulation: Simulation, notes: Mapping[str, Any]) -> None:
    for name, array in state_arrays(simulation):
        file[name] = array
    file.attrs["about"] = json.dumps(identity(simulation) | {"notes": dict(notes)})


def refuse_other_scene(folder: Path, config: SceneConfig) -> None:
    """Refuse to resume a run with another scene or edited parts, before anything is packed or compiled.

    Raises
    ------
    RunError
        If the last checkpoint that can be read belongs to another scene, or a part has changed since.
    """
    for path in _found(folder):
        with suppress(OSError, KeyError, TypeError, ValueError, RuntimeError):
            about = _read(path)[1]
            _refuse_differing(path, about["scene"], _plain(config))
            _refuse_changed(path, changed(about.get("parts", {}), parts_of(config)))
            return


def load(folder: Path, simulation: Simulation) -> dict[str, Any]:
    """Bring a simulation to the state of a run folder's last good checkpoint, and return the notes beside it.

    Raises
    ------
    RunError
        If there is none, none can be read, or it belongs to another scene or other physics.
    """
    found = _found(folder)
    if not found:
        raise RefusedError(f"{folder}: no checkpoint to resume from; run without --resume to start anew")
    reasons = []
    for path in found:
        try:
            arrays, about = _read(path)
            _refuse_other(path, about, identity(simulation))
            _restore(simulation, arrays, about)
            return dict(about["notes"])
        except (OSError, KeyError, TypeError, ValueError, RuntimeError) as error:
            reasons.append(f"{path}: cannot be read ({one_line(error)})")
    raise RefusedError(
        f"{'; '.join(reasons)}: the run cannot go on from here. What it measured can still be read; start it anew in "
        "another folder with -o"
    )


def _found(folder: Path) -> list[Path]:
    return [path for path in (folder / FILE, folder / PREVIOUS) if path.exists()]


def _plain(config: SceneConfig) -> dict[str, Any]:
    """Return a scene as a checkpoint keeps it."""
    return dict(json.loads(json.dumps(config.resolved())))


def state_arrays(simulation: Simulation) -> Iterator[tuple[str, NDArray[Any]]]:
    """Yield every array of the world by name."""
    for group, record in simulation.world._asdict().items():
        if group in DERIVED:
            continue
        if isinstance(record, np.ndarray):
            yield group, record
        else:
            for name, array in record._asdict().items():
                yield f"{group}/{name}", array


def identity(simulation: Simulation) -> dict[str, Any]:
    """Return what must agree for a resume: scene, kernel, step."""
    return {
        "schema": 1,
        "scene": _plain(simulation.config),
        "parts": simulation.parts,
        "kernel": simulation.kernel.digest,
        "dt": simulation.timeline.spans[0].dt,
        "timeline": simulation.timeline.spans,
        "allowance": simulation.keeper.allowance,
        "estimates": simulation.keeper.estimates,
        "above": simulation.keeper.above,
        "balance": simulation.soundness.energy.balance,
        "removed": simulation.removed,
        "lists": [simulation.lists.made, simulation.lists.mended, simulation.lists.spent],
    }


def flat(tree: Any, path: str = "") -> dict[str, Any]:
    """Return a nested mapping as one level with dotted keys; lists of numbers stay as they are.

    >>> flat({"a": [{"b": 1}], "c": [2, 3]})
    {'a.0.b': 1, 'c': [2, 3]}
    """
    if isinstance(tree, list) and any(isinstance(each, dict | list) for each in tree):
        tree = dict(enumerate(tree))
    if not isinstance(tree, dict):
        return {path: tree}
    found: dict[str, Any] = {}
    for key, value in tree.items():
        found |= flat(value, f"{path}.{key}" if path else str(key))
    return found


def _read(path: Path) -> tuple[dict[str, NDArray[Any]], dict[str, Any]]:
    import h5py

    arrays: dict[str, NDArray[Any]] = {}
    with h5py.File(path, "r") as file:
        about = json.loads(file.attrs["about"])
        file.visititems(lambda name, item: arrays.update({name: item[...]}) if hasattr(item, "shape") else None)
    return arrays, about


def _refuse_other(path: Path, old: Mapping[str, Any], new: Mapping[str, Any]) -> None:
    _refuse_differing(path, old["scene"], new["scene"])
    if old["kernel"] != new["kernel"] or old["dt"] != new["dt"]:
        _refuse_changed(path, changed(old.get("parts", {}), new["parts"]) or ["other sources of Clast"])


def _refuse_changed(path: Path, edited: list[str]) -> None:
    if edited:
        raise RefusedError(
            f"{path}: was computed before this changed: {', '.join(edited)}. Going on would mix two physics; start "
            "anew in another folder with -o"
        )


def _refuse_differing(path: Path, old: Mapping[str, Any], new: Mapping[str, Any]) -> None:
    before, now = flat(old), flat(new)
    differing = [
        key
        for key in sorted(before.keys() | now.keys())
        if before.get(key) != now.get(key) and not key.startswith(MAY_DIFFER)
    ]
    if differing:
        shown = "; ".join(f"{key}: {before.get(key)!r} there, {now.get(key)!r} here" for key in differing[:5])
        raise RefusedError(
            f"{path}: belongs to another scene, so it cannot be resumed ({shown}). "
            "Resume with the same file and --set options, or choose another folder with -o"
        )


def _restore(simulation: Simulation, arrays: Mapping[str, NDArray[Any]], about: Mapping[str, Any]) -> None:
    fresh: dict[str, Any] = {}
    for group, record in simulation.world._asdict().items():
        if group in DERIVED:
            continue
        if isinstance(record, np.ndarray):
            fresh[group] = on_line(arrays[group])
        else:
            fresh[group] = on_lines(type(record)(*(arrays[f"{group}/{name}"] for name in record._fields)))
    simulation.world = simulation.world._replace(**fresh)
    simulation.timeline = Timeline(about["timeline"])
    simulation.keeper.allowance = float(about["allowance"])
    simulation.keeper.estimates = int(about["estimates"])
    simulation.keeper.above = float(about["above"])
    simulation.soundness.energy.balance = Balance(*about["balance"])
    simulation.follow_timeline()
    simulation.removed = int(about["removed"])
    simulation.lists.made, simulation.lists.mended, simulation.lists.spent = about["lists"]


def _settle(path: Path) -> None:
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
