"""Unbalance: how far a scene is from rest, as forces tell."""

from __future__ import annotations

import numpy as np

from clast.engine.kernels.layout import INVERSE_MASS, F
from clast.results.found_contacts import find_contacts
from clast.simulation import Simulation

NORMAL, SHEAR = 2, 3
"""Columns of ``Simulation.bond_loads``."""


def unbalanced_force_ratio(simulation: Simulation) -> float:
    """Return the mean force that accelerates a particle over the mean force in what holds it.

    The first is mass times acceleration of all particles that forces can move, at the last force evaluation; the second
    the mean size of the forces of all bonds and contacts. Infinite where nothing holds, 0 where nothing is accelerated.
    """
    particles = simulation.world.particles
    moving = (particles.body[:, INVERSE_MASS] > 0.0) & (particles.present != 0)
    acceleration = np.linalg.norm(particles.acceleration[moving, F : F + 3], axis=1)
    unbalanced = float(np.mean(acceleration / particles.body[moving, INVERSE_MASS])) if moving.any() else 0.0
    held = [np.zeros(0)]
    if simulation.plan.bonds is not None:
        loads = simulation.bond_loads()
        held.append(np.hypot(loads[:, NORMAL], loads[:, SHEAR])[loads[:, 0] > 0.0])
    if simulation.plan.contacts is not None:
        held.append(np.linalg.norm(find_contacts(simulation, inside=True).force.astype(float), axis=1))
    sizes = np.concatenate(held)
    if unbalanced == 0.0:
        return 0.0
    typical = float(sizes.mean()) if len(sizes) else 0.0
    return unbalanced / typical if typical > 0.0 else float("inf")
