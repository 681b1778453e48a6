"""Conditions on the curves: whether a scene has what they look at."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from clast.config.columns import known_columns
from clast.config.document import Problem
from clast.plugins.nearest import suggestion

if TYPE_CHECKING:
    from clast.config.scene import SceneConfig


def blind_conditions(scene: SceneConfig) -> Iterator[Problem]:
    """Yield a problem for each condition that looks at a compression, or at columns, where there are none."""
    known = known_columns(scene)
    for path, each in scene.conditions:
        if each.part.of_compression and scene.compression is None:
            yield Problem(
                path,
                f"{each.name} looks at strain or stress, and the scene has no compression; add one with its two "
                "plates, or take another condition",
            )
        for name in each.part.reads(each.params):
            if name not in known:
                text = f"{each.name} looks at {name!r}, which the curves of this scene lack"
                yield Problem(path, f"{text}; {suggestion(name, known)}")
