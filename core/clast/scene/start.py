"""Start: refuses scenes that would burst or fall through a wall in their first step."""

from __future__ import annotations

import numpy as np

from clast.config.scene import SceneConfig
from clast.scene.bonding import close_pairs
from clast.scene.plan import material_pairs, wall_shapes
from clast.scene.scene import Scene


def check_start(scene: Scene) -> None:
    """Check materials, tracks, and overlaps at the start.

    Raises
    ------
    ConfigError
        If two materials that can touch have no settings, walls have no contact law, a track names what is not there,
        or bodies overlap too much.
    """
    check_contacts(scene)
    check_tracks(scene.config, len(scene.radius), len(scene.ends))
    if scene.config.contacts is not None:
        _refuse_particle_overlaps(scene)
        _refuse_wall_overlaps(scene)


def check_contacts(scene: Scene) -> None:
    """Check what needs no positions: that walls have a contact law, and materials that can touch settings.

    Raises
    ------
    ConfigError
        If they have not.
    """
    if scene.config.contacts is not None:
        material_pairs(scene)
    elif scene.config.walls:
        text = "particles fall through walls without a section 'contacts'; add it with a law, or remove the walls"
        raise scene.config.problem(("walls",), text)


def check_tracks(config: SceneConfig, particles: int, bonds: float) -> None:
    """Check that every particle and bond to be tracked is there.

    Raises
    ------
    ConfigError
        If one is not.
    """
    tracks = config.output.tracks
    for key, numbers, count in (("particles", tracks.particles, particles), ("bonds", tracks.bonds, bonds)):
        for at, number in enumerate(numbers):
            if not 0 <= number < count:
                text = f"there is no number {number}; the number of {key} is {count:.0f}, counted from 0"
                raise config.problem(("output", "tracks", key, at), text)


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
        first, second = ends[k].tolist()
        raise scene.config.problem(
            scene.origin(second),
            f"particle {second} overlaps {_name(scene, first)} by {-gap[k]:.4g} m at the start, {share[k]:.1%} of "
            f"the smaller radius; allowed are {contacts.start_overlap:.1%}. Move them apart, or raise "
            "contacts.start_overlap if they are meant to push each other",
        )


def _name(scene: Scene, particle: int) -> str:
    origin = scene.origin(particle)
    return f"particle {particle}" + (f" ({origin})" if isinstance(origin, str) else "")


def _refuse_wall_overlaps(scene: Scene) -> None:
    contacts = scene.config.contacts
    assert contacts is not None
    for name, (nearest, shape) in zip(scene.config.walls, wall_shapes(scene), strict=True):
        distance = np.array([nearest(shape, tuple(x)).distance for x in scene.position.tolist()])
        share = 1.0 - distance / scene.radius
        share[scene.prescribed] = 0.0
        k = int(np.argmax(share))
        if share[k] > contacts.start_overlap:
            raise scene.config.problem(
                ("walls", name),
                f"{_name(scene, k)} reaches {share[k] * scene.radius[k]:.4g} m into this wall at the start, "
                f"{share[k]:.1%} of its radius; allowed are {contacts.start_overlap:.1%}. Move the wall or the "
                "particle, or raise contacts.start_overlap",
            )
