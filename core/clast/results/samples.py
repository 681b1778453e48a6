"""Samples: the rows of the curves, and the close tracks of chosen particles and bonds."""

from __future__ import annotations

import numpy as np

from clast.config.columns import OF_COMPRESSION, stage_columns, wall_columns
from clast.engine.kernels.layout import F, M, V, W, X
from clast.engine.ledger import Ledger
from clast.engine.state import Floats
from clast.results import energy
from clast.results.cell import cell_columns
from clast.results.stops import Stops
from clast.results.store import Store
from clast.simulation import Simulation

PARTICLE_TRACK = ("position", "velocity", "spin", "force", "moment")
BOND_TRACK = (
    "intact",
    "axial_strain",
    "normal_stress",
    "shear_stress",
    "torsion",
    "bending",
    "failure",
    "energy",
)


class Samples:
    """Observer that takes one row of every curve at regular steps, the first and the last included."""

    def __init__(self, simulation: Simulation, store: Store) -> None:
        output = simulation.config.output
        self.store = store
        self.simulation = simulation
        self.stops = Stops(simulation.config)
        self.every = max(1, round(simulation.planned_steps / output.samples))
        self.mean = output.force == "mean"
        self.particles = np.array(output.tracks.particles, np.int64)
        self.bonds = np.array(output.tracks.bonds, np.int64)
        self.previous_step = 0
        self.wall_columns = wall_columns(simulation.gauge.names)
        self.stage_columns = stage_columns(simulation.config.walls)
        self.stages = [len(wall.stages) for wall in simulation.config.walls.values()]
        curved = [(k, name) for k, (name, wall) in enumerate(simulation.config.walls.items()) if not wall.flat]
        self.curved_columns = {f"normal_force_{name}_N": k for k, name in curved}

    def next_step(self, step: int) -> int | None:
        """Return the next multiple of the interval, and at last the end."""
        if step >= self.simulation.last_step:
            return None
        return min(self.simulation.last_step, self.simulation.timeline.next_multiple(step, self.every))

    def observe(self, simulation: Simulation) -> None:
        """Append one row to every curve and track.

        Raises
        ------
        RunError
            If the numbers cannot be trusted any more.
        """
        ledger = simulation.trusted_ledger()
        row = self._row(simulation, ledger) | self.stops.extra(simulation)
        self.store.append("curves", row)
        if len(self.particles):
            self.store.append("tracks/particles", self._particle_row(simulation))
        if len(self.bonds):
            self.store.append("tracks/bonds", self._bond_row(simulation))
        walls = simulation.world.walls
        walls.force_sum[:] = walls.moment_sum[:] = walls.pressing_sum[:] = 0.0
        self.previous_step = simulation.step
        self.stops.look(simulation, row)

    def _row(self, simulation: Simulation, ledger: Ledger) -> dict[str, float]:
        walls, gauge = simulation.world.walls, simulation.gauge
        steps = simulation.step - self.previous_step
        now, sums = (walls.force, walls.moment, walls.pressing), (walls.force_sum, walls.moment_sum, walls.pressing_sum)
        force, moment, pressing = (each / steps for each in sums) if self.mean and steps else now
        row = {"time_s": simulation.time}
        if gauge.axis is not None:
            upper, lower = gauge.forces(force)
            plates = (gauge.displacement(walls), gauge.strain(walls), upper / gauge.area, upper, lower)
            row |= zip(OF_COMPRESSION, plates, strict=True)
        side = gauge.side_reading(walls, force, pressing)
        row |= side._asdict() if side is not None else {}
        row |= cell_columns(simulation)
        row |= zip(self.wall_columns, np.concatenate((force, moment), axis=1).ravel().tolist(), strict=True)
        row |= {name: float(pressing[k]) for name, k in self.curved_columns.items()}
        row |= {name: self._stage(int(walls.stage[k, 0]), k) for name, k in self.stage_columns.items()}
        row |= {"bonds_intact": simulation.bonds_intact, "bonds_broken": simulation.bonds_broken}
        if simulation.config.boundaries.domain is not None and not simulation.box.periodic.all():
            row["particles_removed"] = simulation.removed
        return row | (energy.columns(ledger) if simulation.plan.ledger else {})

    def _stage(self, number: int, wall: int) -> int:
        """Return the stage of a wall's motion, from 1 on; 0 once all are over."""
        return number + 1 if number < self.stages[wall] else 0

    def _particle_row(self, simulation: Simulation) -> dict[str, Floats]:
        particles, k = simulation.world.particles, self.particles
        tables = (
            particles.pose[k, X : X + 3],
            particles.twist[k, V : V + 3],
            particles.twist[k, W : W + 3],
            particles.load[k, F : F + 3],
            particles.load[k, M : M + 3],
        )
        return dict(zip(PARTICLE_TRACK, tables, strict=True))

    def _bond_row(self, simulation: Simulation) -> dict[str, Floats]:
        scene, k = simulation.scene, self.bonds
        loads = simulation.bond_loads()[k]
        area = 0.25 * np.pi * scene.diameter[k] ** 2
        values = loads.T.copy()
        values[1] /= scene.length[k]
        values[2] /= area
        values[3] /= area
        return dict(zip(BOND_TRACK, values, strict=True))
