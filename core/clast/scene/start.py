"""Start: refuses scenes that would burst or fall through a wall in their first step."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.config.scene import SceneConfig
from clast.engine.wall_feet import feet
from clast.engine.wall_frames import at_start
from clast.maths.box import Box
from clast.scene.bonding import close_pairs
from clast.scene.near_walls import near_walls
from clast.scene.plan import material_pairs, wall_answers
from clast.scene.repeats import check_repeats
from clast.scene.scatter import multiplied, refuse_beyond_bounds, scatter_entries
from clast.scene.scene import Scene
from clast.scene.turning import refuse_endless_bodies

COARSEST = 1e-6
"""Largest distance of two neighbouring floating-point numbers at a particle, as a share of its radius or its bonds'."""


def check_start(scene: Scene) -> None:
    """Check materials, tracks, places and overlaps at the start.

    Raises
    ------
    ConfigError
        If two materials that can touch have no settings, walls have no contact law, a bond model has no bonds, a track
        names what is not there, particles lie outside the domain, are so far from the origin or so near to each other
        that round-off is a visible share of what moves them, a bond's parameters scatter beyond their bounds or do not
        go with its size, or bodies overlap too much.
    """
    check_contacts(scene)
    check_bonds(scene.config, len(scene.ends))
    refuse_beyond_bounds(scene.config, scene.factors)
    _refuse_misfits(scene)
    check_tracks(scene.config, len(scene.radius), len(scene.ends))
    _refuse_outsiders(scene)
    check_repeats(scene)
    refuse_endless_bodies(scene.config)
    _refuse_coarse_positions(scene)
    _refuse_short_bonds(scene)
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


def check_bonds(config: SceneConfig, bonds: float) -> None:
    """Check that a scene with a bond model says what to bond.

    Raises
    ------
    ConfigError
        If it does not.
    """
    if config.bonds is not None and config.bonds.between is None and bonds == 0:
        text = (
            "no particles are bonded; add 'between' with a 'max_gap', or bonds to the particles, or remove this section"
        )
        raise config.problem(("bonds",), text)


def _refuse_misfits(scene: Scene) -> None:
    config = scene.config
    if config.bonds is None or config.bonds.model.part.misfit is None or len(scene.ends) == 0:
        return
    params = multiplied(config.bonds.model.params, scatter_entries(config), scene.factors)
    text = config.bonds.model.part.misfit(params, scene.bond_geometry)
    if text is not None:
        raise config.problem(("bonds", "model"), text)


def check_tracks(config: SceneConfig, particles: float, bonds: float) -> None:
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


def _refuse_outsiders(scene: Scene) -> None:
    domain = scene.config.boundaries.domain
    if domain is None:
        return
    outside = outside_of(scene.box, scene.position)
    if outside.any():
        k = int(np.argmax(outside))
        x, y, z = scene.position[k]
        more = f", and so are {outside.sum() - 1} others" if outside.sum() > 1 else ""
        raise scene.config.problem(
            scene.origin(k),
            f"particle {k}, centred at ({x:.4g}, {y:.4g}, {z:.4g}) m, is outside boundaries.domain at the start{more}; "
            "move it, or make the domain larger",
        )


def outside_of(box: Box, position: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell which of (n, 3) centres in m lie outside a box, (n,), in a direction in which it does not repeat itself."""
    return np.asarray((((position < box.lower) | (position > box.upper)) & ~box.periodic).any(axis=1))


def _refuse_coarse_positions(scene: Scene) -> None:
    grain = _round_off(scene)
    k = int(np.argmax(grain / scene.radius))
    if grain[k] > COARSEST * scene.radius[k]:
        raise scene.config.problem(
            scene.origin(k),
            f"particle {k} lies {np.abs(scene.position[k]).max():.4g} m from the origin, where positions are "
            f"{grain[k]:.2g} m apart, {grain[k] / scene.radius[k]:.1g} of its radius: too coarse for overlaps. "
            "Move the scene nearer to the origin",
        )


def _refuse_short_bonds(scene: Scene) -> None:
    if len(scene.ends) == 0:
        return
    distance = np.linalg.norm(scene.bond_vectors, axis=1)
    needed = _round_off(scene)[scene.ends].max(axis=1) / COARSEST
    k = int(np.argmin(distance - needed))
    if not distance[k] > needed[k]:
        first, second = scene.ends[k].tolist()
        raise scene.config.problem(
            scene.origin(second),
            f"the centres of {_name(scene, first)} and particle {second}, which are bonded, are {distance[k]:.2g} m "
            "apart: too little to tell the direction of the bond. Move them apart, or remove the bond",
        )


def _round_off(scene: Scene) -> NDArray[np.float64]:
    """Return how far apart floating-point numbers are at each particle, in m."""
    return np.asarray(np.spacing(np.abs(scene.position).max(axis=1)))


def _refuse_particle_overlaps(scene: Scene) -> None:
    contacts = scene.config.contacts
    assert contacts is not None
    ends, gap = close_pairs(scene.position, scene.radius, 0.0, scene.box)
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
    near = near_walls(scene, scene.position, at_start(len(scene.config.walls)))
    for w, (name, wall) in enumerate(scene.config.walls.items()):
        here = near[near[:, 0] == w, 1]
        here = here if wall_answers(wall) else here[~scene.prescribed[here]]
        found = feet(wall.shape.part, wall.shape.params, scene.position[here], scene.radius[here])
        share = np.zeros(len(scene.radius))
        np.maximum.at(share, here[found.point], 1.0 - found.distance / scene.radius[here[found.point]])
        k = int(np.argmax(share))
        if share[k] > contacts.start_overlap:
            raise scene.config.problem(
                ("walls", name),
                f"{_name(scene, k)} reaches {share[k] * scene.radius[k]:.4g} m into this wall at the start, "
                f"{share[k]:.1%} of its radius; allowed are {contacts.start_overlap:.1%}. Move the wall or the "
                "particle, or raise contacts.start_overlap",
            )
