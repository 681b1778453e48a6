"""Runs of impacts: how spheres move before and after, and how long by Hertz they touch."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from clast.config.contacts import PairSettings
from clast.simulation import Simulation
from clast.verification.bench import Bench
from clast.verification.closed_forms.hertz import HertzImpact, effective_modulus
from clast.verification.closed_forms.sliding import Motion
from clast.verification.reading import position, spin, velocity

STARTS = 1.0 + 0.01 * np.arange(4)
"""The step is made this much smaller, so that contacts begin at four different points within a step."""


def overlap_with_floor(simulation: Simulation, i: int) -> float:
    """Return how far particle i reaches below z = 0 in m; a gap is negative."""
    return float(simulation.scene.radius[i] - position(simulation)[i, 2])


def on_floor(simulation: Simulation, i: int) -> HertzImpact:
    """Return the closed form of particle i, which falls on the floor without damping."""
    scene, materials = simulation.scene, simulation.config.materials
    own = list(materials.values())[scene.material[i]]
    modulus = effective_modulus(own, materials[simulation.config.walls["floor"].material])
    return HertzImpact(modulus, float(scene.radius[i]), float(scene.mass[i]), -float(scene.velocity[i, 2]))


def between(simulation: Simulation, i: int, j: int) -> HertzImpact:
    """Return the closed form of the particles i and j, which meet head-on without damping."""
    scene, materials = simulation.scene, list(simulation.config.materials.values())
    modulus = effective_modulus(*(materials[scene.material[k]] for k in (i, j)))
    radius, mass = (harmonic_sum(each[i], each[j]) for each in (scene.radius, scene.mass))
    return HertzImpact(modulus, radius, mass, float(np.linalg.norm(scene.velocity[j] - scene.velocity[i])))


def harmonic_sum(a: float, b: float) -> float:
    """Return 1/(1/a + 1/b)."""
    return float(a * b / (a + b))


def with_floor(simulation: Simulation, i: int) -> PairSettings:
    """Return the settings of particle i and the floor."""
    contacts, materials = simulation.config.contacts, list(simulation.config.materials)
    assert contacts is not None
    found = contacts.pair(materials[simulation.scene.material[i]], simulation.config.walls["floor"].material)
    assert found is not None
    return found


def motion(simulation: Simulation) -> Motion:
    """Return how all spheres move over the floor now."""
    v = velocity(simulation)
    return Motion(-v[:, 2], v[:, 0], simulation.scene.radius * spin(simulation)[:, 1])


class Row:
    """Some spheres of a scene that hit the floor, or something else below them, all at once and each for itself.

    Parameters
    ----------
    bench : Bench
    spheres : slice
        Which of the particles.
    changes : mapping
        Values of the scene that are changed in all runs.
    impact : (simulation, i) -> HertzImpact
        Closed form without damping, which tells how long a contact takes.

    Attributes
    ----------
    before : Motion
    radius, duration, restitution, friction : array
        (n,) of each sphere: in m; in s, of its contact without damping; as written for it and the floor.
    """

    def __init__(
        self,
        bench: Bench,
        spheres: slice = slice(None),
        changes: Mapping[str, Any] | None = None,
        impact: Callable[[Simulation, int], HertzImpact] = on_floor,
    ) -> None:
        self._bench, self._spheres, self._changes = bench, spheres, dict(changes or {})
        self._known: dict[tuple[int, float], Motion] = {}
        start = bench.start(self._changes)
        here = range(*spheres.indices(len(start.scene.radius)))
        self.radius = start.scene.radius[spheres]
        self.duration = np.array([impact(start, i).duration for i in here])
        self.restitution = np.array([with_floor(start, i).restitution for i in here])
        self.friction = np.array([with_floor(start, i).sliding_friction for i in here])
        self.before = self._row_of(motion(start))

    def after(self, count: int, start: float = 1.0) -> Motion:
        """Return how each sphere leaves when its own contact takes so many steps.

        Parameters
        ----------
        count : int
            Steps per contact.
        start : float
            One of ``STARTS``.
        """
        if (count, start) not in self._known:
            result = Motion(*(np.zeros(len(self.radius)) for _ in Motion._fields))
            for duration in np.unique(self.duration):
                own = self.duration == duration
                for into, value in zip(result, self._run(duration / (count * start)), strict=True):
                    into[own] = value[own]
            self._known[count, start] = result
        return self._known[count, start]

    def reference(self, count: int) -> Motion:
        """Return how the spheres leave when the shortest of their contacts takes so many steps."""
        return self._run(float(self.duration.min()) / count)

    def _run(self, step: float) -> Motion:
        return self._row_of(motion(self._bench.run({**self._changes, "time.step": step})))

    def _row_of(self, every: Motion) -> Motion:
        return Motion(*(each[self._spheres] for each in every))


def starts(row: Row, count: int) -> list[Motion]:
    """Return how the spheres of a row leave, from each of ``STARTS``."""
    return [row.after(count, start) for start in STARTS]
