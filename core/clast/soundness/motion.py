"""Motion: what is nowhere, what a step moves or turns too far, and particles that have passed into each other."""

from __future__ import annotations

import numpy as np

from clast.engine.blueprint import Blueprint
from clast.engine.kernels.layout import INTACT, PER_SPAN, RADIUS, WALL_W, V, W, X
from clast.engine.state import Integers, World
from clast.engine.tables import box_of, slot_view
from clast.scene.scene import Scene
from clast.soundness.near import Nearness
from clast.soundness.suspects import suspects

Some = Integers | slice
"""Which particles are looked at."""
ALL = slice(None)
MOST_WAY = 0.5
"""Longest way of a particle or wall in one step, as a share of the smallest radius."""
MOST_TURN = 0.5
"""Largest turn of a particle in one step in rad; beyond it orientations lose digits."""
LONGEST_WAY = 0.45
"""Longest bond that holds, as a share of a side of a periodic box."""
DEEPEST = 1.0
"""Largest overlap, as a share of the smaller radius: beyond it a centre lies inside the other body."""


def lost(world: World, scene: Scene, some: Some = ALL) -> str | None:
    """Return which particle has no position or velocity any more, and which laws may have caused it."""
    particles = world.particles
    if np.isfinite(particles.pose[some]).all() and np.isfinite(particles.twist[some]).all():
        return None
    numbers = np.isfinite(particles.pose).all(axis=1) & np.isfinite(particles.twist).all(axis=1)
    missing = ~numbers & (particles.present != 0)
    if not missing.any():
        return None
    return f"particle {np.argmax(missing)} is nowhere: {suspects(world, scene, missing)}"


def too_fast(world: World, scene: Scene, plan: Blueprint, dt: float, some: Some = ALL) -> str | None:
    """Return which particle one step of ``dt`` seconds moves or turns too far."""
    most_way, most_turn = MOST_WAY * scene.radius.min() / dt, MOST_TURN / dt
    fastest = np.abs(world.particles.twist[some])
    way, turn = (fastest[:, k : k + 4].max(initial=0.0) for k in (V, W))
    if way <= most_way and turn <= most_turn:
        return None
    twist = np.where(world.particles.present[:, None] != 0, world.particles.twist, 0.0)
    ways = np.abs(twist[:, V : V + 3]).max(axis=1) * dt / scene.radius.min()
    k = int(np.argmax(ways))
    if ways[k] > MOST_WAY:
        return f"particle {k} moves by {ways[k]:.2g} times the smallest radius in one step"
    turns = np.abs(twist[:, W : W + 3]).max(axis=1) * dt
    k = int(np.argmax(turns))
    if plan.spin and turns[k] > MOST_TURN:
        return f"particle {k} turns by {turns[k]:.2g} rad in one step"
    return None


def wall_out_of_hand(world: World, scene: Scene, dt: float) -> str | None:
    """Return which wall has no place any more, or turns too far in one step of ``dt`` seconds."""
    walls, names = world.walls, list(scene.config.walls)
    sound = np.isfinite(walls.pose).all(axis=1) & np.isfinite(walls.twist).all(axis=1)
    if not sound.all():
        return f"the wall '{names[int(np.argmin(sound))]}' is nowhere: look at its mass, its inertia and what moves it"
    turns = np.linalg.norm(walls.twist[:, WALL_W:], axis=1) * dt
    if len(turns) and turns.max() > MOST_TURN:
        k = int(np.argmax(turns))
        return f"the wall '{names[k]}' turns by {turns[k]:.2g} rad in one step"
    return None


def round_the_other_way(world: World) -> str | None:
    """Return which bond spans so much of a periodic side that its ends are hardly nearer this way than the other."""
    bonds, box = world.bonds, box_of(world.particles)
    if box is None or not len(bonds.first):
        return None
    place = world.particles.pose[:, X : X + 3]
    away = (place[bonds.second] - place[bonds.first]) * box[PER_SPAN]
    share = np.abs(away - np.rint(away)).max(axis=2) * (slot_view(bonds, INTACT) == 1.0)
    if share.max() <= LONGEST_WAY:
        return None
    b, lane = np.unravel_index(np.argmax(share), share.shape)
    return (
        f"the bond of particles {bonds.first[b, lane]} and {bonds.second[b, lane]} spans {share.max():.2g} of a side "
        "of the periodic box, and from a half on it would go round the other way; make the box larger"
    )


def passed_through(near: Nearness, world: World, scene: Scene) -> str | None:
    """Return which particle overlaps so far that one's centre is inside the other body."""
    if scene.config.contacts is None:
        return None
    deepest = max(DEEPEST, scene.config.contacts.start_overlap)
    if near.largest <= deepest * scene.radius.min():
        return None
    (i, j, _, overlap), walls, radius = near.pairs, near.walls, world.particles.pose[:, RADIUS]
    share = overlap / np.minimum(radius[i], radius[j])
    if len(share) and share.max() > deepest:
        k = int(np.argmax(share))
        told = f"{share[k]:.2g} times the smaller radius"
        return f"particles {i[k]} and {j[k]} overlap by {told}: one is passing through the other"
    through = walls.overlap > deepest * radius[walls.second]
    if through.any():
        k = int(np.argmax(through))
        name = list(scene.config.walls)[walls.first[k]]
        return f"particle {walls.second[k]} is passing through the wall '{name}'"
    return None
