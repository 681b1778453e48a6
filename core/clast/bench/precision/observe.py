"""What a problem looks at: numbers at fixed instants of physical time, whatever the scheme and its step."""

from __future__ import annotations

import numpy as np

from clast.engine.kernels.layout import V, W, X
from clast.engine.state import Floats
from clast.simulation import Simulation

NEIGHBOURS = (-1, 0, 1, 2)


def positions(simulation: Simulation, steps: int, instants: int) -> Floats:
    """Return the centres at the start and at evenly spaced instants, (instants + 1, n, 3), in m."""
    seen = [_centres(simulation)]
    for k in range(1, instants + 1):
        simulation.advance_to(k * steps // instants)
        seen.append(_centres(simulation))
    return np.array(seen)


def velocities(simulation: Simulation, steps: int, instants: int) -> Floats:
    """Return mean velocities between evenly spaced instants, (instants, n, 3), in m/s.

    They are read off positions: schemes differ in the instant to which their stored velocities belong.
    """
    return np.asarray(np.diff(positions(simulation, steps, instants), axis=0) * (instants / (steps * simulation.dt)))


def last_velocities(simulation: Simulation, steps: int, instants: int) -> Floats:
    """Return velocities and spin times radius at the end, (n, 6) in m/s; nothing touches any more by then."""
    simulation.advance_to(steps)
    twist = simulation.world.particles.twist
    surface = twist[:, W : W + 3] * simulation.scene.radius[:, None]
    return np.hstack([twist[:, V : V + 3], surface])


def plate_force(simulation: Simulation, steps: int, instants: int) -> Floats:
    """Return the force on the upper plate along the plates' normal at evenly spaced instants, (instants,) in N.

    Forces belong to the instant within the step at which the scheme evaluates them; a cubic through the four
    nearest tells the force at the instants asked for.
    """
    late = evaluated_at(simulation)
    seen = []
    for k in range(1, instants + 1):
        middle = k * steps // instants
        forces = [_force_after(simulation, middle + offset) for offset in NEIGHBOURS]
        seen.append(lagrange([offset - 1.0 + late for offset in NEIGHBOURS], forces))
    return np.array(seen)


def evaluated_at(simulation: Simulation) -> float:
    """Return when within a step the last forces are evaluated, as a fraction of it."""
    *before, last = simulation.plan.integrator.stages
    return sum(stage.drift_before + stage.drift_after for stage in before) + last.drift_before


def lagrange(places: list[float], values: list[float]) -> float:
    """Return the polynomial through some points at 0.

    >>> lagrange([-2.0, -1.0, 1.0], [4.5, 1.5, 1.5])
    0.5
    """
    total = 0.0
    for i, x in enumerate(places):
        weight = 1.0
        for j, other in enumerate(places):
            if j != i:
                weight *= other / (other - x)
        total += weight * values[i]
    return total


def _centres(simulation: Simulation) -> Floats:
    return np.array(simulation.world.particles.pose[:, X : X + 3])


def _force_after(simulation: Simulation, step: int) -> float:
    simulation.advance_to(step)
    return float(simulation.gauge.forces(simulation.world.walls.force)[0])
