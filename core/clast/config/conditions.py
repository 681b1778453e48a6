"""Conditions that end a run: whether a scene has what they look at."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from clast.config.document import Problem

if TYPE_CHECKING:
    from clast.config.scene import SceneConfig


def blind_conditions(scene: SceneConfig) -> Iterator[Problem]:
    """Yield a problem for each condition that looks at a compression where there is none."""
    for k, each in enumerate(scene.stop):
        if each.part.of_compression and scene.compression is None:
            yield Problem(
                ("stop", k),
                f"{each.name} looks at strain or stress, and the scene has no compression; add one with its two "
                "plates, or take another condition",
            )
