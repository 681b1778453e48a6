"""Reading a simulation: copies of what its particles do, and histories of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.engine.kernels.layout import F, M, Q, V, W, X
from clast.simulation import Simulation

Floats = NDArray[np.float64]


def position(simulation: Simulation) -> Floats:
    """Return all centres, (n, 3) in m."""
    return simulation.world.particles.pose[:, X : X + 3].copy()


def orientation(simulation: Simulation) -> Floats:
    """Return all orientations, (n, 4) quaternions (w, x, y, z)."""
    return simulation.world.particles.pose[:, Q : Q + 4].copy()


def velocity(simulation: Simulation) -> Floats:
    """Return all velocities, (n, 3) in m/s."""
    return simulation.world.particles.twist[:, V : V + 3].copy()


def spin(simulation: Simulation) -> Floats:
    """Return all angular velocities, (n, 3) in rad/s."""
    return simulation.world.particles.twist[:, W : W + 3].copy()


def force(simulation: Simulation) -> Floats:
    """Return the forces on all particles at the last evaluation, (n, 3) in N."""
    return simulation.world.particles.load[:, F : F + 3].copy()


def moment(simulation: Simulation) -> Floats:
    """Return the moments on all particles at the last evaluation, (n, 3) in N m."""
    return simulation.world.particles.load[:, M : M + 3].copy()


def follow(simulation: Simulation, read: Callable[[Simulation], Any], every: int = 1) -> Any:
    """Run a simulation to its end and return what ``read`` tells at the start and after every so many steps.

    Returns
    -------
    array
        One row per look; or a tuple of arrays, where ``read`` returns a tuple.
    """
    told = [read(simulation)]
    while simulation.step < simulation.last_step:
        simulation.advance_to(min(simulation.step + every, simulation.last_step))
        told.append(read(simulation))
    if isinstance(told[0], tuple):
        return tuple(np.array(column) for column in zip(*told, strict=True))
    return np.array(told)


def evaluation(simulation: Simulation) -> float:
    """Return when within a step forces are last evaluated, by the positions they see, as a share of the step."""
    drifts = [drift for stage in simulation.plan.integrator.stages for drift in (stage.drift_before, stage.drift_after)]
    return float(sum(drifts[:-1]))
