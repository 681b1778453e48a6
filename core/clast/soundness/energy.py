"""Energy from nowhere: a scene into which nothing brings energy must not have more of it than at the start."""

from __future__ import annotations

import numpy as np

from clast.engine.blueprint import Blueprint
from clast.engine.kernels.layout import INVERSE_MASS, MATERIAL, RADIUS
from clast.engine.ledger import kinetic_energy
from clast.engine.state import Floats, World
from clast.scene.scene import Scene
from clast.soundness.near import Energies, at_walls, near_pairs

SPARE = 2.0
STILL = 1e-9


class ClosedEnergy:
    """Compares the energy of a closed scene with that at the start.

    Closed is a scene without body forces, applied loads, moving walls and moving prescribed particles. Energy measured
    at full steps is larger than that of the motion by up to 1/(1 − s²), s the share of the step in its limit; twice
    that is allowed.

    Parameters
    ----------
    scene : Scene
    plan : Blueprint
    share : float
        Time step over the limit of the scene at its start.
    """

    def __init__(self, scene: Scene, plan: Blueprint, share: float) -> None:
        self.scene, self.plan = scene, plan
        self.energies = Energies(scene, plan)
        moved = np.abs(scene.velocity[scene.prescribed]).sum() + np.abs(scene.spin[scene.prescribed]).sum()
        self.closed = not (plan.body_forces or plan.applied_loads or plan.motions or moved > 0.0)
        self.allowed = SPARE / (1.0 - min(share, 0.95) ** 2) if share < 1.0 else SPARE
        self.start = 0.0

    def begin(self, world: World, bonds: Floats, dt: float) -> None:
        """Note the energy at the start; ``bonds`` holds that of each bond in J."""
        if self.closed:
            slow = STILL * float(self.scene.radius.min()) / dt  # what round-off alone may bring about
            least = 0.5 * float(self.scene.mass.sum()) * slow**2
            self.start = self._moving(world, bonds) + max(self._contacts(world), 0.0) + least

    def complaint(self, world: World, bonds: Floats) -> str | None:
        """Return how much too much there is."""
        if not self.closed or self._moving(world, bonds) <= self.allowed * self.start:
            return None
        found = self._moving(world, bonds) + self._contacts(world)
        if not found > self.allowed * self.start:
            return None
        return f"it holds {found / self.start:.2g} times the energy of its start, and nothing has brought any in"

    def _moving(self, world: World, bonds: Floats) -> float:
        """Return kinetic energy and that of the bonds in J."""
        return kinetic_energy(world.particles, 0.0) + float(bonds.sum())

    def _contacts(self, world: World) -> float:
        """Return the energy of everything that touches, without slip, in J."""
        if not self.energies.constants:
            return 0.0
        radius, body, total = world.particles.pose[:, RADIUS], world.particles.body, 0.0
        i, j, _, overlap = near_pairs(world, self.plan)
        for k in np.nonzero(overlap > 0.0)[0].tolist():
            materials = (int(body[i[k], MATERIAL]), int(body[j[k], MATERIAL]))
            per_mass = float(body[i[k], INVERSE_MASS] + body[j[k], INVERSE_MASS])
            total += self.energies.of(materials, (float(radius[i[k]]), float(radius[j[k]])), per_mass)(overlap[k])
        for wall, particle, _, depth in at_walls(world, self.scene):
            if depth > 0.0:
                materials = (int(body[particle, MATERIAL]), int(world.walls.material[wall]))
                per_mass = float(body[particle, INVERSE_MASS])
                total += self.energies.of(materials, (float(radius[particle]), np.inf), per_mass)(depth)
        return total
