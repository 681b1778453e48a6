"""Concerns: what a user should know of a scene before it runs, and a reader before its results are believed."""

from __future__ import annotations

from clast.scene.foretold import foretold
from clast.scene.held import not_held
from clast.scene.narrow_plates import narrow_plates
from clast.scene.rooms import open_faces
from clast.scene.scene import Scene


def concerns(scene: Scene) -> list[str]:
    """Return a sentence for each: what generators missed, open rooms, narrow plates, particles that nothing holds."""
    config = scene.config
    bare = [text for chosen in config.generators for text in open_faces(config, chosen, foretold(config, chosen))]
    narrow = narrow_plates(config, 2.0 * float(scene.radius.min()))
    return [*scene.concerns, *narrow, *(bare or not_held(scene))]
