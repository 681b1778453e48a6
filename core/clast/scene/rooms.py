"""Rooms: whether the walls of a scene stand where a generator fills a room: at its faces, and not in it."""

from __future__ import annotations

import numpy as np

from clast.config.beside import WallChoice
from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.parts.generator import Prediction
from clast.parts.room import Floats


def refuse_intruders(config: SceneConfig, told: Prediction) -> None:
    """Refuse a wall that reaches into the room that a generator fills.

    A wall outside the room is at least as far from a point in it as the room's own faces are.

    Raises
    ------
    ConfigError
        If one reaches farther in than particles may overlap with walls at the start.
    """
    if told.room is None or config.contacts is None:
        return
    for name, wall in config.walls.items():
        reach = float((told.room.depth - _distances(wall, told.room.inside)).max())
        if reach > config.contacts.start_overlap * told.radius:
            raise config.problem(
                ("walls", name),
                f"this wall reaches {1e3 * reach:.4g} mm into the room that is filled with particles, "
                f"{told.room.text}; move it out, or turn its face towards them, or fill a smaller room",
            )


def open_faces(config: SceneConfig, chosen: Chosen, told: Prediction | None) -> list[str]:
    """Return a sentence about the faces of a room beside which no wall stands; none where particles may leave."""
    if told is None or told.room is None or config.boundaries.domain is not None:
        return []
    away = {face: _farthest(config, points) for face, points in told.room.faces.items()}
    bare = {face: found for face, found in away.items() if found[0] > told.radius}
    if not bare:
        return []
    distance, place = max(bare.values(), key=lambda found: found[0])
    x, y, z = 1e3 * place
    nearest = f": the nearest is {1e3 * distance:.3g} mm from ({x:.3g}, {y:.3g}, {z:.3g}) mm" if config.walls else ""
    text = (
        f"fills {told.room.text}, and no wall stands at its {' and its '.join(bare)}{nearest}. Particles will leave "
        "there: add walls, or make those that are there match the room"
    )
    return [config.remark(config.path_of(chosen), text)]


def _farthest(config: SceneConfig, points: Floats) -> tuple[float, Floats]:
    """Return how far the point is from all walls that is farthest from them, in m, and the point."""
    if not config.walls:
        return np.inf, points[0]
    away = np.min([np.abs(_distances(wall, points)) for wall in config.walls.values()], axis=0)
    k = int(np.argmax(away))
    return float(away[k]), points[k]


def _distances(wall: WallChoice, points: Floats) -> Floats:
    return np.array([wall.distance(x) for x in points])
