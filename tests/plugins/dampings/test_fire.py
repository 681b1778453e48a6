"""FIRE: it stops a swing where forces turn, rests soft rows soon, and gives the same bits for any number of threads."""

from math import inf, pi
from pathlib import Path

import numpy as np
import pytest

from clast.building import build_scene
from clast.config.scene import load
from clast.engine import chunks
from clast.engine.kernels.layout import DOWNHILL
from clast.engine.slots_text import slots_text
from clast.errors import ConfigError
from clast.plugins.discovery import discover
from clast.results import checkpoint
from clast.scene.plan import blueprint, refuse_steering
from clast.simulation import Simulation
from clast.testing.damping import added
from clast.verification.bench import scene_file

FIRE, LOCAL = (discover().get("damping", name).part for name in ("fire", "local"))
STEPS, LONGEST = 2000, 20000


def test_a_swing_is_stopped_where_the_force_turns():
    h, x, v, steps = 2.0 * pi / STEPS, 1.0, 0.0, 0
    while x > 0.0:
        v += h * (-x + braked(x, v, h))
        x += h * v
        steps += 1
    assert steps == pytest.approx(STEPS / 4, abs=2)
    assert v < -0.9
    assert v + h * braked(x, v, h) == pytest.approx(0.0, abs=1e-15)


def braked(x, v, h):
    """Return what is added to the acceleration of a mass on a spring, x'' = −x."""
    (more,) = added(FIRE, FIRE.numbers(FIRE.Params()), [(-x, 0.0, 0.0)], [(v, 0.0, 0.0)], h)
    return more[0]


def steps_to_rest(damping, count=50, left=1e-6):
    """Return the steps after which a row of masses on springs, held at one end, comes to what is left of its start."""
    stiffness = 2.0 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)
    stiffness[-1, -1] = 1.0
    known = damping.numbers(damping.Params())
    h, downhill = 0.9 * damping.step_share(damping.Params()), 0
    x, v = np.linspace(0.0, 1.0, count), np.zeros(count)
    for step in range(LONGEST):
        a = -stiffness @ x
        downhill = downhill + 1 if a @ v > 0.0 else 0
        rows = [[(value, 0.0, 0.0) for value in table.tolist()] for table in (a, v)]
        v += h * (a + [more[0] for more in added(damping, known, *rows, h, max(downhill - 1, 0))])
        x += h * v
        if np.abs(x).max() < left:
            return step
    return inf


def test_a_long_row_rests_in_a_quarter_of_the_steps_of_local_damping():
    assert steps_to_rest(FIRE) < 0.25 * steps_to_rest(LOCAL)


@pytest.fixture
def cut_small(monkeypatch):
    """Cut scenes of a few particles into several chunks."""
    monkeypatch.setattr(chunks, "SIZE", 6)
    monkeypatch.setattr(chunks, "LARGE", 9)


def test_the_same_bits_for_any_number_of_threads_and_after_a_resume(cut_small, tmp_path: Path):
    config = load(scene_file("damping_fire"), ["output.writers=[]"])
    alone, together, stopped, resumed = (Simulation(config, threads) for threads in (1, 2, 2, 1))
    assert len(alone.world.chunks) > 3
    for simulation in (alone, together):
        simulation.advance_to(1500)
    stopped.advance_to(100)  # within the first run downhill: what has been counted by then matters
    assert stopped.world.clock[DOWNHILL] > 90
    checkpoint.save(tmp_path, stopped, {})
    checkpoint.load(tmp_path, resumed)
    resumed.advance_to(1500)
    assert 0 < alone.world.clock[DOWNHILL] < 1000
    for other in (together, resumed):
        for table in ("pose", "twist", "acceleration"):
            np.testing.assert_array_equal(getattr(other.world.particles, table), getattr(alone.world.particles, table))
        np.testing.assert_array_equal(other.world.ledger, alone.world.ledger)


def test_an_integrator_that_asks_for_forces_several_times_a_step_is_refused():
    config = load(scene_file("damping_fire"), ["integrator.type=pefrl", "output.ledger=false"])
    with pytest.raises(ConfigError, match=r"'fire' steers all .* integrator 'pefrl' evaluates forces 4 times"):
        refuse_steering(config)


def test_nothing_is_summed_up_where_no_damping_asks_for_it():
    config = load(scene_file("damping_local"))
    text = slots_text(blueprint(build_scene(config)))
    assert "STEERS = False" in text
