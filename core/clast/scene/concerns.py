"""Concerns: what a user should know of a scene before it runs, and a reader before its results are believed."""

from __future__ import annotations

from collections.abc import Sequence

from clast.config.scene import SceneConfig
from clast.parts.generator import Prediction
from clast.scene.bodies import odd_bodies
from clast.scene.foretold import foretold
from clast.scene.held import not_held
from clast.scene.narrow_plates import narrow_plates
from clast.scene.rooms import open_faces
from clast.scene.scene import Scene


def concerns(scene: Scene) -> list[str]:
    """Return a sentence for each: what generators missed, open rooms, narrow plates, odd bodies, what nothing holds."""
    config = scene.config
    told = [foretold(config, chosen) for chosen in config.generators]
    bare = rooms_left_open(config, told)
    narrow = narrow_plates(config, 2.0 * float(scene.radius.min()))
    return [*concerns_of_parts(config, told), *scene.concerns, *narrow, *odd_bodies(scene), *(bare or not_held(scene))]


def rooms_left_open(config: SceneConfig, told: Sequence[Prediction | None]) -> list[str]:
    """Return a sentence for each room that a generator fills and at which walls are missing."""
    return [text for each in zip(config.generators, told, strict=True) for text in open_faces(config, *each)]


def concerns_of_parts(config: SceneConfig, told: Sequence[Prediction | None]) -> list[str]:
    """Return what walls, and generators before they pack, have to say of themselves."""
    of_walls = [
        config.remark(("walls", name), text)
        for name, wall in config.walls.items()
        for text in wall.shape.part.concerns(wall.shape.params)
    ]
    of_generators = [
        config.remark(config.path_of(chosen), text)
        for chosen, each in zip(config.generators, told, strict=True)
        for text in (each.concerns if each is not None else ())
    ]
    return [*of_walls, *of_generators]
