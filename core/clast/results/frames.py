"""Frames: the whole scene at a moment, for recordings, pictures and later questions."""

from __future__ import annotations

import numpy as np

from clast.engine.kernels.layout import WALL_Q, Q, V, X
from clast.results.contacts import ENDS, GROUP
from clast.results.found_contacts import find_contacts, keeps_contacts
from clast.results.store import Store
from clast.simulation import Simulation


class Frames:
    """Observer that keeps the whole scene at regular steps, the first and the last included."""

    def __init__(self, simulation: Simulation, store: Store) -> None:
        self.store = store
        self.simulation = simulation
        frames = simulation.config.output.frames
        self.contacts = keeps_contacts(simulation.scene)
        self.every = max(1, round(simulation.planned_steps / frames)) if frames else 0

    def next_step(self, step: int) -> int | None:
        """Return the next multiple of the interval, and at last the end."""
        if self.every == 0 or step >= self.simulation.last_step:
            return None
        return min(self.simulation.last_step, self.simulation.timeline.next_multiple(step, self.every))

    def observe(self, simulation: Simulation) -> None:
        """Append the scene; bond loads are computed here, at the positions shown."""
        scene, particles, box = simulation.scene, simulation.world.particles, simulation.box
        gone = particles.present == 0
        place = particles.pose[:, X : X + 3]
        with np.errstate(over="ignore"):  # a run that blows up is reported by the simulation
            position = box.wrapped(place).astype(np.float32)
            velocity = particles.twist[:, V : V + 3].astype(np.float32)
        position[gone] = np.nan
        row = {
            "time": simulation.time,
            "step": simulation.step,
            "strain": simulation.gauge.strain(simulation.world.walls),
            "position": position,
            "velocity": velocity,
            "wall_displacement": simulation.world.walls.displacement,
        }
        if simulation.plan.walls_turn:
            row["wall_orientation"] = simulation.world.walls.pose[:, WALL_Q:]
        if box.repeats:
            row |= {"image": box.images(place).astype(np.int32), "box": np.array([box.lower, box.upper])}
        if simulation.plan.orientation:
            row["orientation"] = particles.pose[:, Q : Q + 4].astype(np.float32)
        if simulation.plan.ledger:
            row["energy"] = np.array(simulation.ledger())
        loads = simulation.bond_loads()
        row["bond_intact"] = loads[:, 0].astype(np.uint8)
        row["bond_stress"] = (loads[:, 2] / (0.25 * np.pi * scene.diameter**2)).astype(np.float32)
        row["bond_failure"] = loads[:, 6].astype(np.float32)
        if self.contacts:
            row[ENDS] = self._keep_contacts(simulation)
        self.store.append("frames", row)
        self.store.keep_up(simulation)

    def _keep_contacts(self, simulation: Simulation) -> int:
        """Append what touches, before the frame that tells of it; return how many contacts are kept up to now."""
        found = find_contacts(simulation, inside=simulation.config.output.contacts == "all")
        self.store.extend(GROUP, found._asdict())
        return self.store.known(GROUP)
