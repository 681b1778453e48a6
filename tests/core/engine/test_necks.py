"""Contacts that hold beyond touch: through new neighbour lists, over chunks and threads, and through a checkpoint."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from clast.config.scene import SceneConfig, from_mapping
from clast.engine import chunks
from clast.engine.kernels.layout import FIRST, X
from clast.results import checkpoint
from clast.simulation import Simulation

STEPS, STOP, COUNT, RADIUS = 300, 50, 24, 1e-4


def row_of_spheres(skin: str) -> SceneConfig:
    """Return a row of soft, sticky spheres that touch and are thrown about."""
    v = np.random.default_rng(3).normal(size=(COUNT, 3)) * [0.3, 0.03, 0.03]
    places = [[k * 1.99 * RADIUS, 0.0, 0.0] for k in range(COUNT)]
    particles = [{"position": x, "radius": RADIUS, "velocity": u} for x, u in zip(places, v.tolist(), strict=True)]
    return from_mapping(
        {
            "materials": {"rubber": {"density": 1000.0, "young_modulus": 1e6, "poisson_ratio": 0.4}},
            "particles": {"type": "explicit", "material": "rubber", "particles": particles},
            "contacts": {
                "law": {"type": "jkr", "work_of_adhesion": 0.1},
                "pairs": {"default": {"restitution": 0.9, "sliding_friction": 0.5}},
            },
            "neighbours": {"skin": skin},
            "time": {"step": 2e-7, "end": {"time": STEPS * 2e-7}},
            "output": {"ledger": True},
        }
    )


def beyond_touch(simulation: Simulation) -> int:
    """Return how many contacts hold whose bodies do not overlap."""
    pairs, x = simulation.world.pairs, simulation.world.particles.pose[:, X : X + 3]
    gap = np.linalg.norm(x[pairs.second] - x[pairs.first], axis=1) - 2.0 * RADIUS
    return int(((pairs.touching != 0) & (pairs.sides & FIRST != 0) & (gap > 0.0)).sum())


def contacts(simulation: Simulation) -> int:
    pairs = simulation.world.pairs
    return int(((pairs.touching != 0) & (pairs.sides & FIRST != 0)).sum())


def assert_same(one: Simulation, other: Simulation) -> None:
    for table, expected in zip(one.world.particles, other.world.particles, strict=True):
        if table is not one.world.particles.reference:  # where lists were made differs, and may
            np.testing.assert_array_equal(table, expected)
    assert one.ledger() == other.ledger()


def test_necks_are_the_same_whatever_lists_threads_and_checkpoints(monkeypatch: pytest.MonkeyPatch, tmp_path: Path):
    monkeypatch.setattr(chunks, "SIZE", 8)
    monkeypatch.setattr(chunks, "LARGE", 12)
    whole, renewed = Simulation(row_of_spheres("50 um"), 1), Simulation(row_of_spheres("0.2 um"), 2)
    assert len(whole.world.chunks) > 2
    whole.advance_to(STOP)
    assert beyond_touch(whole) > 2
    checkpoint.save(tmp_path, whole, {})
    whole.advance_to(STEPS)
    assert 0 < contacts(whole) < COUNT - 3
    renewed.advance_to(STEPS)
    assert renewed.lists.made > 20
    assert_same(renewed, whole)
    resumed = Simulation(row_of_spheres("50 um"), 1)
    checkpoint.load(tmp_path, resumed)
    resumed.advance_to(STEPS)
    assert_same(resumed, whole)
    assert abs(whole.ledger().closure) < 1e-4
