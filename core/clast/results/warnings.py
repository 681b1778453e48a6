"""Warnings: what a reader must know before the numbers of a run are believed."""

from __future__ import annotations

from typing import Any

from clast.config.sections import Compression
from clast.scene.concerns import concerns
from clast.scene.scene import Scene

MOST_UNBALANCED = 0.05
"""Share of the force on the upper wall that lower wall and side may leave over, or bring, without a warning."""


def warnings(scene: Scene, told: dict[str, Any]) -> list[str]:
    """Return a sentence for each, about the scene and about what a summary tells of its compression."""
    pressed = scene.config.compression
    return [*concerns(scene), *(() if pressed is None else compression_warnings(pressed, told))]


def compression_warnings(pressed: Compression, told: dict[str, Any]) -> list[str]:
    """Return what is wrong with a compression: an upper wall that met nothing, or forces that do not balance."""
    if told.get("peak_stress_Pa", 1.0) <= 0.0:
        return [
            f"walls.{pressed.upper} met nothing in the whole run, so there is no stress; let it begin nearer to the "
            "particles, or go farther"
        ]
    share = told.get("side_wall", {}).get("over_the_loading", {}).get("unbalanced_share")
    if share is None or share <= MOST_UNBALANCED:
        return []
    carrying = " and ".join(f"walls.{name}" for name in (pressed.lower, *pressed.side))
    return [
        f"{carrying} carry {share:.1%} more or less than walls.{pressed.upper} "
        "presses with (mean over the loading): what is pressed is not at rest. Lower the velocity of the walls or "
        "time.mass_scaling"
    ]
