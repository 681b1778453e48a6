"""Start: refuses scenes that would burst or fall through a wall in their first step."""

from __future__ import annotations

import numpy as np

from clast.errors import ConfigError
from clast.scene.bonding import close_pairs
from clast.scene.plan import material_pairs, wall_shapes
from clast.scene.scene import Scene


def check_start(scene: Scene) -> None:
    """Check materials and overlaps at the start.

    Raises
    ------
    ConfigError
        If two materials that can touch have no settings, walls have no contact law, or bodies overlap too much.
    """
    if scene.config.contacts is None:
        if scene.config.walls:
            raise ConfigError("walls: need 'contacts' with a law, or particles fall through them")
        return
    material_pairs(scene)
    _refuse_particle_overlaps(scene)
    _refuse_wall_overlaps(scene)


def _refuse_particle_overlaps(scene: Scene) -> None:
    contacts = scene.config.contacts
    assert contacts is not None
    ends, gap = close_pairs(scene.position, scene.radius, 0.0)
    i, j = ends.T
    share = -gap / np.minimum(scene.radius[i], scene.radius[j])
    share[scene.relieved[i] & scene.relieved[j]] = 0.0
    share[scene.prescribed[i] & scene.prescribed[j]] = 0.0
    if not contacts.bonded_pairs and len(scene.ends):
        n = len(scene.radius)
        bonded = np.sort(scene.ends, axis=1) @ np.array([n, 1])
        share[np.isin(np.sort(ends, axis=1) @ np.array([n, 1]), bonded)] = 0.0
    if len(share) and share.max() > contacts.start_overlap:
        k = int(np.argmax(share))
        raise ConfigError(
            f"particles: {i[k]} and {j[k]} overlap by {-gap[k]:.4g} m at the start, {share[k]:.1%} of the smaller "
            f"radius; allowed are {contacts.start_overlap:.1%}. Move them apart, or raise contacts.start_overlap if "
            "they are meant to push each other"
        )


def _refuse_wall_overlaps(scene: Scene) -> None:
    contacts = scene.config.contacts
    assert contacts is not None
    for name, (nearest, shape) in zip(scene.config.walls, wall_shapes(scene), strict=True):
        distance = np.array([nearest(shape, tuple(x)).distance for x in scene.position.tolist()])
        share = 1.0 - distance / scene.radius
        share[scene.prescribed] = 0.0
        k = int(np.argmax(share))
        if share[k] > contacts.start_overlap:
            raise ConfigError(
                f"walls.{name}: particle {k} reaches {share[k] * scene.radius[k]:.4g} m into it at the start, "
                f"{share[k]:.1%} of its radius; allowed are {contacts.start_overlap:.1%}. Move the wall or the "
                "particles apart"
            )
