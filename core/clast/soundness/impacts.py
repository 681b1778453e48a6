"""Impacts ahead: bodies about to meet so fast that their impact is over within a few steps."""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt
from typing import NamedTuple

import numpy as np

from clast.engine.blueprint import Blueprint
from clast.engine.images import growth, velocities_between
from clast.engine.kernels.layout import INVERSE_MASS, MATERIAL, RADIUS, V, X
from clast.engine.state import Floats, World
from clast.engine.wall_frames import fastest_surface, surface_velocities
from clast.scene.plan import giving_way
from clast.scene.scene import Scene
from clast.soundness.near import Energies, Nearness
from clast.stability.impact import impact_duration

LEAST_STEPS = 5.0
"""Fewest steps of an impact; with fewer its restitution is wrong by more than some per cent."""


class Meeting(NamedTuple):
    """Two bodies about to meet: who, their materials and radii (infinite for a wall), 1/m* in 1/kg, speed in m/s."""

    who: str
    materials: tuple[int, int]
    radii: tuple[float, float]
    per_mass: float
    speed: float


def fastest(velocity: Floats) -> float:
    """Return the largest speed among velocities, (n, 3)."""
    return sqrt(np.einsum("kc,kc->k", velocity, velocity).max(initial=0.0))


class ImpactsAhead:
    """Finds impacts that a step cannot resolve, before they happen.

    While nothing moves faster than a speed at which even the shortest impact of the scene is resolved, no pair is
    looked at.
    """

    def __init__(self, scene: Scene, plan: Blueprint) -> None:
        self.scene = scene
        self.energies = Energies(scene, plan)
        self.giving_way = [giving_way(wall) for wall in scene.config.walls.values()]
        self.harmless = 0.0

    def complaint(self, near: Nearness, world: World, dt: float) -> str | None:
        """Return who is about to meet too fast for steps of ``dt`` seconds."""
        if not self.energies.constants:
            return None
        closing = 2.0 * fastest(world.particles.twist[:, V : V + 3]) + fastest_surface(world.walls)
        closing += growth(world.particles)
        if closing <= self.harmless:
            return None
        if all(self.steps(each, dt) >= LEAST_STEPS for each in self._shortest(1.25 * closing)):
            self.harmless = 1.25 * closing
            return None
        for meeting in self._meetings(near, world):
            steps = self.steps(meeting, dt)
            if steps < LEAST_STEPS:
                return (
                    f"{meeting.who} are about to meet with {meeting.speed:.3g} m/s, and their impact will be over in "
                    f"{steps:.2g} steps, where {LEAST_STEPS:g} are the least"
                )
        return None

    def steps(self, meeting: Meeting, dt: float) -> float:
        """Return how many steps an impact lasts, without damping."""
        energy = self.energies.of(meeting.materials, meeting.radii, meeting.per_mass)
        size = min(meeting.radii)
        return impact_duration(energy, 1.0 / meeting.per_mass, meeting.speed, size) / dt

    def _shortest(self, speed: float) -> Iterator[Meeting]:
        """Yield the meetings of the smallest particles of every two materials, and of one and a wall."""
        scene, materials = self.scene, list(self.scene.config.materials)
        walls = [materials.index(wall.material) for wall in scene.config.walls.values()]
        present = set(scene.material.tolist())
        lightest = {m: np.argmin(np.where(scene.material == m, scene.mass, np.inf)) for m in present}
        for i, j in self.energies.constants:
            if i not in present:
                continue
            r, per_mass = float(scene.radius[lightest[i]]), 1.0 / float(scene.mass[lightest[i]])
            if j in present:
                other = lightest[j]
                together = per_mass + 1.0 / float(scene.mass[other])
                yield Meeting("", (i, j), (r, float(scene.radius[other])), together, speed)
            for wall, given in zip(walls, self.giving_way, strict=True):
                if wall == j:
                    yield Meeting("", (i, j), (r, np.inf), per_mass + given, speed)

    def _meetings(self, near: Nearness, world: World) -> Iterator[Meeting]:
        """Yield the near pair whose impact would be the shortest, and everything near walls."""
        particles, body = world.particles, world.particles.body
        radius, v = particles.pose[:, RADIUS], particles.twist[:, V : V + 3]
        i, j, normal, overlap = near.pairs
        closing = -np.einsum("kc,kc->k", velocities_between(particles, i, j), normal)
        ahead = np.nonzero((overlap < 0.0) & (closing > 0.0))[0]
        if len(ahead):
            i, j, closing = i[ahead], j[ahead], closing[ahead]
            k = int(np.argmin(radius[i] * radius[j] / (radius[i] + radius[j]) * closing**-0.2))  # as Hertz's duration
            a, b = int(i[k]), int(j[k])
            materials = (int(body[a, MATERIAL]), int(body[b, MATERIAL]))
            per_mass = float(body[a, INVERSE_MASS] + body[b, INVERSE_MASS])
            radii = (float(radius[a]), float(radius[b]))
            yield Meeting(f"particles {a} and {b}", materials, radii, per_mass, float(closing[k]))
        walls, beside, towards, depth = near.walls
        surface = surface_velocities(world.walls, walls, world.particles.pose[beside, X : X + 3])
        speed = np.einsum("kc,kc->k", v[beside] - surface, towards)
        for p in np.nonzero((depth < 0.0) & (speed > 0.0))[0].tolist():
            one, wall = int(beside[p]), int(walls[p])
            who = f"particle {one} and the wall '{list(self.scene.config.walls)[wall]}'"
            materials = (int(body[one, MATERIAL]), int(world.walls.material[wall]))
            radii = (float(radius[one]), np.inf)
            per_mass = float(body[one, INVERSE_MASS]) + self.giving_way[wall]
            yield Meeting(who, materials, radii, per_mass, float(speed[p]))
