"""Forces and torques that act on particles all the time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from clast import Simulation
from clast.building import build_scene
from clast.config.scene import SceneConfig, from_mapping
from clast.engine import chunks
from clast.engine.kernels.layout import V, W, X
from clast.engine.slots_text import slots_text
from clast.errors import ConfigError
from clast.results import checkpoint
from clast.scene.plan import blueprint
from tests.support.integrators import INTEGRATORS
from tests.support.strategies import vectors

R = 1e-3
MASS = 2500.0 * 4.0 / 3.0 * np.pi * R**3
INERTIA = 0.4 * MASS * R**2
STEPS, DT = 300, 1e-7


def chain(count: int, loads: dict[int, dict[str, Any]], bonded: bool = True, **more: Any) -> SceneConfig:
    """Return a row of spheres, each bonded to the next, with loads on some."""
    particles = [{"position": [2.2 * R * k, 0, 0], "radius": R, **loads.get(k, {})} for k in range(count)]
    bonds = [{"between": [k, k + 1], "diameter": R} for k in range(count - 1)] if bonded else []
    model = {"type": "elastic", "young_modulus": 1e8, "poisson_ratio": 0.2, "normal_strength": 1e12}
    return from_mapping(
        {
            "materials": {"glass": {"density": 2500, "young_modulus": 1e8, "poisson_ratio": 0.2}},
            "particles": {"type": "explicit", "material": "glass", "particles": particles, "bonds": bonds},
            **({"bonds": {"model": model}} if bonded else {}),
            "time": {"step": DT, "end": {"steps": STEPS}},
        }
        | more
    )


def after(config: SceneConfig, steps: int = STEPS) -> Simulation:
    """Return a scene after some steps."""
    simulation = Simulation(config)
    simulation.advance_to(steps)
    return simulation


@given(vectors(1.0), vectors(1.0), vectors(1e-3))
@settings(max_examples=20)
def test_momentum_and_angular_momentum_are_what_was_applied(f: Any, g: Any, torque: Any) -> None:
    simulation = Simulation(chain(3, {0: {"force": f}, 2: {"force": g, "torque": torque}}))
    particles, turned = simulation.world.particles, np.zeros(3)
    x, v, w = particles.pose[:, X : X + 3], particles.twist[:, V : V + 3], particles.twist[:, W : W + 3]
    for step in range(1, STEPS + 1):
        arm = x + 0.5 * DT * v  # where forces are evaluated
        turned += DT * (np.cross(arm[0], f) + np.cross(arm[2], g) + np.array(torque))
        simulation.advance_to(step)
    most = STEPS * DT * (float(np.abs([*f, *g]).max()) + float(np.abs(torque).max()) / R)
    applied = STEPS * DT * (np.array(f) + np.array(g))
    np.testing.assert_allclose(MASS * v.sum(axis=0), applied, atol=1e-12 * most, rtol=0)
    momentum = MASS * np.cross(x, v).sum(axis=0) + INERTIA * w.sum(axis=0)
    np.testing.assert_allclose(momentum, turned, atol=1e-12 * most * R, rtol=0)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_lone_sphere_gains_speed_and_spin_as_newton_and_euler_say(integrator: str) -> None:
    load = {"force": ["2 mN", 0, "-1 mN"], "torque": [0, "3 uN m", 0]}
    particles = after(chain(1, {0: load}, bonded=False, integrator=integrator)).world.particles
    time = STEPS * DT
    np.testing.assert_allclose(particles.twist[0, V : V + 3], [2e-3 * time / MASS, 0, -1e-3 * time / MASS], rtol=1e-12)
    np.testing.assert_allclose(particles.twist[0, W : W + 3], [0, 3e-6 * time / INERTIA, 0], rtol=1e-12)


def test_mass_scaling_leaves_applied_forces_as_they_are() -> None:
    load = {0: {"force": [1e-3, 0, 0]}}
    time = {"step": DT, "end": {"steps": STEPS}, "mass_scaling": 4}
    speed = after(chain(1, load, bonded=False, time=time)).world.particles.twist[0, V]
    assert speed == pytest.approx(1e-3 * STEPS * DT / (4.0 * MASS), rel=1e-12)


def test_what_a_scene_does_not_load_is_not_compiled() -> None:
    def compiled(loads: dict[int, dict[str, Any]]) -> str:
        return slots_text(blueprint(build_scene(chain(2, loads))))

    assert "APPLIED_LOADS = True" in compiled({0: {"force": [1, 0, 0]}})
    assert "APPLIED_LOADS = True" in compiled({1: {"torque": [0, 0, 1]}})
    assert compiled({0: {"force": [0, 0, 0], "torque": [0, 0, 0]}}) == compiled({})
    assert "APPLIED_LOADS = False" in compiled({})


def test_bits_depend_neither_on_chunks_nor_on_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    config = chain(30, {k: {"force": [0.1 * k, 1.0, -0.2], "torque": [1e-3, 0, 1e-4 * k]} for k in range(0, 30, 2)})
    whole = after(config)
    monkeypatch.setattr(chunks, "SIZE", 8)
    monkeypatch.setattr(chunks, "LARGE", 12)
    for threads in (1, 2):
        cut = Simulation(config, threads)
        assert len(cut.world.chunks) > 2
        cut.advance_to(STEPS)
        for name in ("pose", "twist", "load", "applied"):
            np.testing.assert_array_equal(getattr(cut.world.particles, name), getattr(whole.world.particles, name))


def test_a_resumed_run_carries_on_with_its_loads(tmp_path: Path) -> None:
    config = chain(3, {2: {"force": [0, 0, 1.0], "torque": [0, 1e-3, 0]}})
    whole, stopped, resumed = after(config), after(config, STEPS // 3), Simulation(config)
    checkpoint.save(tmp_path, stopped, {})
    checkpoint.load(tmp_path, resumed)
    resumed.advance_to(STEPS)
    for table, other in zip(resumed.world.particles, whole.world.particles, strict=True):
        np.testing.assert_array_equal(table, other)
    assert np.abs(whole.world.particles.twist).max() > 0.0


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"force": ["1 mm", 0, 0]}, "particles.particles.0.force.0: '1 mm' is a length; a force is needed"),
        ({"torque": [0, 0, "1 N"]}, "particles.particles.0.torque.2: '1 N' is a force; an energy or moment is needed"),
        ({"force": [1, 0]}, "a vector has three components"),
        ({"fixed": True, "force": [1, 0, 0]}, "'fixed: true' means that no load moves the particle, but a force"),
        ({"prescribed": True, "torque": [1, 0, 0]}, "but a torque is given; remove one of them"),
    ],
)
def test_loads_that_make_no_sense_are_refused(wrong: dict[str, Any], told: str) -> None:
    with pytest.raises(ConfigError) as refused:
        chain(1, {0: wrong}, bonded=False)
    assert told in str(refused.value)
