"""Overlaps at the start push nothing until their particles have been wholly apart, whatever lists are made."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from clast import Simulation, load
from clast.engine.kernels.layout import V
from tests.scenes import CRUSH, write

DENSE = ["particles.primaries=75", "particles.accept_overlap=true", "bonds.model.breakage_strain=0.002"]


def dense(folder: Path, *settings: str) -> Simulation:
    """Return a grain whose primaries overlap, far more than their tolerance allows."""
    simulation = Simulation(load(write(folder, CRUSH), [*DENSE, "time.step=1e-7", *settings]), 1)
    assert simulation.world.pairs.rest.max() > 1e-6
    return simulation


def test_no_bit_depends_on_when_lists_are_made(tmp_path: Path) -> None:
    """Fragments part, and some of their particles meet again: those that had overlapped at the start, too."""
    fast = "walls.upper.motion.velocity=[0, 0, -0.5]"
    ends = []
    for skin in ("2e-6", "5e-5"):
        simulation = dense(tmp_path, fast, f"neighbours.skin={skin}")
        simulation.advance_to(6000)
        ends.append(simulation)
    seldom, often = ends[1], ends[0]
    assert often.lists.made > 4 * seldom.lists.made
    assert seldom.bonds_broken > 100
    for name, table in seldom.world.particles._asdict().items():
        if name != "reference":
            np.testing.assert_array_equal(table, getattr(often.world.particles, name), err_msg=name)


@pytest.mark.parametrize(("away", "forgotten"), [(0.9, False), (1.1, True)])
def test_an_overlap_is_forgotten_once_its_particles_were_wholly_apart(
    tmp_path: Path, away: float, forgotten: bool
) -> None:
    simulation = dense(tmp_path)
    world = simulation.world
    k = int(np.argmax(world.pairs.rest))
    i, j, rest = int(world.pairs.first[k]), int(world.pairs.second[k]), float(world.pairs.rest[k])
    way = world.particles.pose[j, :3] - world.particles.pose[i, :3]
    n = way / np.linalg.norm(way)
    simulation.advance_to(1)
    world.particles.pose[j, :3] += away * rest * n
    world.particles.twist[:, V : V + 3] = 0.0
    simulation.advance_to(2)
    assert float(world.pairs.rest[k]) == (0.0 if forgotten else rest)
