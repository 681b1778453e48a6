"""Finding the contact network of a running scene."""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.results.contacts import Contacts, grain_count
from clast.scene.scene import Scene
from clast.simulation import Simulation

COLUMNS = 10


def find_contacts(simulation: Simulation, inside: bool = False) -> Contacts:
    """Return what touches in a simulation as it stands, which does not change by it.

    Parameters
    ----------
    simulation : Simulation
    inside : bool
        Whether contacts between particles of one grain count too.
    """
    world, network = simulation.world, simulation.kernel.network
    given: tuple[Any, ...] = (world, simulation.step > 0, simulation.scene.grain, inside)
    found = np.zeros((network(*given, np.zeros((0, COLUMNS))), COLUMNS))
    network(*given, found)
    return Contacts(
        i=found[:, 0].astype(np.uint32),
        j=found[:, 1].astype(np.int32),
        position=simulation.box.wrapped(found[:, 2:5]).astype(np.float32),
        force=found[:, 5:8].astype(np.float32),
        normal_force=found[:, 8].astype(np.float32),
        tangential_force=found[:, 9].astype(np.float32),
    )


def keeps_contacts(scene: Scene) -> bool:
    """Tell whether frames of a scene hold its contacts: where asked for, or else where there is more than one grain."""
    chosen = scene.config.output.contacts
    if scene.config.contacts is None or chosen is False:
        return False
    return chosen != "auto" or grain_count(scene.grain) > 1
