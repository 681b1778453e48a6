"""Motion: particles that are nowhere, that a step moves or turns too far, or that have passed into each other."""

from __future__ import annotations

import numpy as np

from clast.engine.blueprint import Blueprint
from clast.engine.kernels.layout import RADIUS, V, W
from clast.engine.state import World
from clast.scene.scene import Scene
from clast.soundness.near import at_walls, near_pairs

MOST_WAY = 0.5
"""Longest way of a particle in one step, as a share of the smallest radius."""
MOST_TURN = 0.5
"""Largest turn of a particle in one step in rad; beyond it orientations lose digits."""
DEEPEST = 1.0
"""Largest overlap, as a share of the smaller radius: beyond it a centre lies inside the other body."""


def lost(world: World) -> str | None:
    """Return which particle has no position or velocity any more."""
    particles = world.particles
    numbers = np.isfinite(particles.pose).all(axis=1) & np.isfinite(particles.twist).all(axis=1)
    missing = ~numbers & (particles.present != 0)
    return f"particle {np.argmax(missing)} is nowhere" if missing.any() else None


def too_fast(world: World, scene: Scene, plan: Blueprint, dt: float) -> str | None:
    """Return which particle one step of ``dt`` seconds moves or turns too far."""
    twist = np.where(world.particles.present[:, None] != 0, world.particles.twist, 0.0)
    way = np.abs(twist[:, V : V + 3]).max(axis=1) * dt / scene.radius.min()
    k = int(np.argmax(way))
    if way[k] > MOST_WAY:
        return f"particle {k} moves by {way[k]:.2g} times the smallest radius in one step"
    turn = np.abs(twist[:, W : W + 3]).max(axis=1) * dt
    k = int(np.argmax(turn))
    if plan.spin and turn[k] > MOST_TURN:
        return f"particle {k} turns by {turn[k]:.2g} rad in one step"
    return None


def passed_through(world: World, scene: Scene, plan: Blueprint) -> str | None:
    """Return which particles overlap so far that one's centre is inside the other body."""
    if plan.contacts is None or scene.config.contacts is None:
        return None
    deepest = max(DEEPEST, scene.config.contacts.start_overlap)
    pairs, radius = near_pairs(world, plan), world.particles.pose[:, RADIUS]
    share = pairs.overlap / np.minimum(radius[pairs.i], radius[pairs.j])
    if len(share) and share.max() > deepest:
        k = int(np.argmax(share))
        told = f"{share[k]:.2g} times the smaller radius"
        return f"particles {pairs.i[k]} and {pairs.j[k]} overlap by {told}: one is passing through the other"
    for wall, particle, _, overlap in at_walls(world, scene):
        if overlap > deepest * radius[particle]:
            return f"particle {particle} is passing through the wall '{list(scene.config.walls)[wall]}'"
    return None
