"""Rest: finds the static answer of a scene by dynamic relaxation.

Whenever the kinetic energy of a grain has passed a maximum, where it is nearest to equilibrium, its velocities and
spins are set to zero. What is found does not depend on that: it is where the loads on every particle add up to nothing.

Source: kinetic damping, M. R. Barnes (1999), doi:10.1260/0266351991494722.
"""

from __future__ import annotations

import numpy as np

from clast.engine.kernels.layout import INVERSE_MASS, F, M, V, W
from clast.errors import RunError
from clast.simulation import Simulation
from clast.verification.curves import Floats

MOST_LOOKS = 200_000


def settle(simulation: Simulation, tolerance: float, every: int) -> None:
    """Advance until every grain rests.

    Parameters
    ----------
    simulation : Simulation
        Grains with a constant force or torque on each, and something that holds them.
    tolerance : float
        Largest force that may be left on a particle, as a share of what is applied to its grain; moments likewise,
        with the lengths of the grains as arms.
    every : int
        Steps between two looks: a small part of the slowest vibration.

    Raises
    ------
    RunError
        The scene does not come to rest.
    """
    before = energies(simulation)
    for _ in range(MOST_LOOKS):
        simulation.advance_to(simulation.step + every)
        now = energies(simulation)
        over_the_top = (now < before)[simulation.scene.grain]
        simulation.world.particles.twist[over_the_top & ~simulation.scene.prescribed] = 0.0
        before = np.where(now < before, 0.0, now)
        if residual(simulation).max() < tolerance:
            return
    raise RunError(f"the scene does not come to rest: {residual(simulation).max():.2g} of its loads are left")


def energies(simulation: Simulation) -> Floats:
    """Return the kinetic energy of every grain in J."""
    scene, twist = simulation.scene, simulation.world.particles.twist
    inertia = 0.4 * scene.mass * scene.radius**2
    moving = scene.mass * (twist[:, V : V + 3] ** 2).sum(axis=1) + inertia * (twist[:, W : W + 3] ** 2).sum(axis=1)
    return np.asarray(np.bincount(scene.grain, weights=np.where(scene.prescribed, 0.0, 0.5 * moving)))


def residual(simulation: Simulation) -> Floats:
    """Return what is left of the loads on each particle, (n,): the share of what is applied to its grain."""
    scene, load = simulation.scene, simulation.world.particles.load
    arm = np.ptp(scene.position, axis=0).max()
    applied = np.linalg.norm(scene.force, axis=1) + np.linalg.norm(scene.torque, axis=1) / arm
    left = np.linalg.norm(load[:, F : F + 3], axis=1) + np.linalg.norm(load[:, M : M + 3], axis=1) / arm
    free = simulation.world.particles.body[:, INVERSE_MASS] > 0.0
    return np.asarray(np.where(free, left, 0.0) / np.bincount(scene.grain, weights=applied)[scene.grain])
