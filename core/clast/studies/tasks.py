"""Tasks: every run of a study as a scene of its own, with a name that tells it apart."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from clast.config.document import dotted
from clast.config.quantities import read_quantity
from clast.config.scene import SceneConfig
from clast.config.yaml_loader import dump_yaml
from clast.errors import ConfigError, KeyPath
from clast.studies.config import StudyConfig
from clast.studies.design import Point, axes, points

LONGEST = 48
"""Characters of a run's name that tell its values."""


@dataclass(frozen=True)
class Task:
    """One run of a study.

    Attributes
    ----------
    name : str
        Of its scene and its folder: its values, and a digest of the whole scene; two runs that are the same have
        the same name.
    variant : str
    point : int
        Number of the point.
    repeat : int
    settings : tuple of Setting
    scene : str
        The scene as YAML, in SI.
    """

    name: str
    variant: str
    point: int
    repeat: int
    settings: Point
    scene: str


class Owner(Protocol):
    """The file that asks for runs."""

    def problem(self, path: KeyPath, text: str) -> ConfigError:
        """Error with its place in the file in front."""


def tasks(study: StudyConfig) -> list[Task]:
    """Return all runs of a study, those of one variant and point after each other.

    Raises
    ------
    ConfigError
        A varied key that does not exist, or a value that the scene does not allow.
    """
    found = []
    for variant, own in study.variant_changes.items():
        place = ("variants", variant) if variant else ("set",)
        _refuse_what_is_varied(study, own, place)
        scene = changed(study, study.scene, study.changes | dict(own), place)
        for number, point in enumerate(points(study)):
            here = at_point(study, scene, point, "vary")
            found += repeated(here, variant, number, point, study.repeats, study.grain)
    return found


def _refuse_what_is_varied(study: StudyConfig, changes: Mapping[str, Any], place: KeyPath) -> None:
    """Refuse a variant that changes what the axes set anyway: it would be no variant."""
    for axis in axes(study):
        for key in axis.factors:
            if key in changes:
                raise study.problem((*place, key), f"axis {axis.name!r} sets this key at every point; leave out one")


def at_point(owner: Owner, scene: SceneConfig, point: Point, section: str) -> SceneConfig:
    """Return a scene with the settings of a point, whose axes stand in a section of the file that asks for them.

    All are set before any is checked: values may only make sense together.
    """
    try:
        return scene.changed(_together(scene, point))
    except (ConfigError, ValueError) as error:
        raise owner.problem(_culprit(scene, point, section), str(error)) from None


def _together(scene: SceneConfig, point: Point) -> dict[str, Any]:
    """Return the changes of all settings, those that multiply after those that set."""
    changes = {key: value for setting in point for key, value in setting.changes.items()}
    for setting in point:
        for key, factor in setting.factors.items():
            changes[key] = factor * _value_of(scene, changes, key)
    return changes


def _value_of(scene: SceneConfig, changes: Mapping[str, Any], key: str) -> float:
    if key in changes:
        return read_quantity(changes[key])[0]
    path = tuple(key.split("."))
    if not scene.document.has(path):
        raise ValueError(f"the scene does not say {key!r}, so there is nothing to multiply")
    return read_quantity(scene.document.get(path))[0]


def _culprit(scene: SceneConfig, point: Point, section: str) -> KeyPath:
    """Return the place of the first setting that fails by itself; that of all, where none does."""
    for setting in point:
        try:
            scene.changed(_together(scene, (setting,)))
        except (ConfigError, ValueError):
            return (section, setting.axis)
    return (section,)


def repeated(scene: SceneConfig, variant: str, number: int, point: Point, repeats: int, grain: str) -> list[Task]:
    """Return the repeats of a point, each with seeds of its own."""
    found = []
    for repeat in range(repeats):
        shift = number * repeats + repeat if grain == "per_run" else repeat
        again = scene.changed(shifted_seeds(scene, shift, same_grain=grain == "same"))
        found.append(task(again, variant, number, repeat, point))
    return found


def changed(owner: Owner, scene: SceneConfig, changes: Mapping[str, Any], place: KeyPath) -> SceneConfig:
    """Return a scene with some values changed; what is wrong with them is told with its place in the file."""
    try:
        return scene.changed(changes) if changes else scene
    except ConfigError as error:
        raise owner.problem(place, str(error)) from None


def task(scene: SceneConfig, variant: str, point: int, repeat: int, settings: Point) -> Task:
    """Return a scene as a task."""
    text = dump_yaml(scene.resolved())
    values = [variant, *(setting.slug or setting.label for setting in settings)]
    slug = re.sub(r"[^A-Za-z0-9.=+-]+", "_", "-".join(value for value in values if value)).strip("_.-")[:LONGEST]
    digest = hashlib.sha256(text.encode()).hexdigest()[:10]
    return Task(f"{slug}-{digest}" if slug else digest, variant, point, repeat, settings, text)


def shifted_seeds(scene: SceneConfig, shift: int, same_grain: bool) -> dict[str, int]:
    """Return all seeds of a scene plus a shift, but those of its packing where the grain stays the same."""
    if shift == 0:
        return {}
    every = _seeds(scene.resolved(), ())
    return {dotted(path): seed + shift for path, seed in every if not same_grain or path[0] != "particles"}


def _seeds(value: Any, path: KeyPath) -> Iterator[tuple[KeyPath, int]]:
    if isinstance(value, Mapping):
        for key, inner in value.items():
            if key == "seed" and isinstance(inner, int):
                yield (*path, key), inner
            yield from _seeds(inner, (*path, key))
    elif isinstance(value, list):
        for index, inner in enumerate(value):
            yield from _seeds(inner, (*path, index))
