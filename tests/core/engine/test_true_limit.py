"""The limit of the time step is that of the dense matrix of everything that holds and touches."""

from __future__ import annotations

from math import sqrt
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from clast import load
from clast.building import build_scene
from clast.config.scene import SceneConfig, from_mapping
from clast.plugins.discovery import discover
from clast.scene.plan import blueprint
from clast.stability.damped_step import sensitivity, stable_step
from clast.stability.impact import impact_duration
from clast.stability.local_bounds import local_bounds
from clast.stability.response import respond
from clast.stability.springs import Bodies, Springs, bodies_at_start, springs_at_start
from clast.stability.time_step import contact_limit, limits
from clast.stability.vibration import largest_eigenvalue
from clast.verification.dense_springs import largest
from tests.support.contacts import GLASS, contact
from tests.support.strategies import numbers

GRAIN = Path("configs/paper/fig09_model1.yaml")


def pressed(seed: int, porosity: float, restitution: float) -> tuple[SceneConfig, Springs, Bodies]:
    """Return a grain of the paper between plates that reach 2 % of a radius into it, and its springs."""
    pairs = {"default": {"restitution": restitution, "sliding_friction": 0.3}}
    changes = {"particles.seed": seed, "particles.porosity": porosity, "contacts.pairs": pairs}
    config = load(GRAIN).changed(changes)
    grain = build_scene(config)
    z, inside = grain.position[:, 2], 0.98 * grain.radius[0]
    plates = {"walls.lower.point": [0, 0, z.min() - inside], "walls.upper.point": [0, 0, z.max() + inside]}
    config = config.changed({key: [0.0, 0.0, float(point[2])] for key, point in plates.items()})
    scene = build_scene(config)
    return config, springs_at_start(scene, blueprint(scene)), bodies_at_start(scene)


@pytest.mark.parametrize(
    ("seed", "porosity", "restitution"), [(1, 0.44, 1.0), (2, 0.44, 0.5), (3, 0.65, 0.0), (4, 0.75, 0.5)]
)
def test_the_limit_of_a_grain_is_that_of_the_dense_matrix(seed: int, porosity: float, restitution: float) -> None:
    config, springs, bodies = pressed(seed, porosity, restitution)
    assert (springs.second == len(bodies.radius)).any(), "the plates touch"
    exact = largest(springs, bodies)
    assert 0.995 * exact <= largest_eigenvalue(springs, bodies) <= 1.02 * exact
    scene = build_scene(config)
    found = limits(scene, blueprint(scene))
    exact = 2.0 / sqrt(largest(springs, bodies, 4.0 / found.spectral))  # the limit is where this is the step
    assert found.spectral == pytest.approx(exact, rel=0.01)
    assert 0.6 * exact <= found.local <= exact


@st.composite
def tangles(draw: st.DrawFn) -> tuple[Springs, Bodies]:
    """Draw a few bodies of very different mass, held together and to a wall by random springs and dashpots."""
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n, s = draw(st.integers(1, 9)), draw(st.integers(1, 30))
    radius = 10.0 ** random.uniform(-2.0, 0.0, n)
    per_mass = random.permutation(np.where(np.arange(n) == 1, 0.0, 1.0)) / radius**3
    first = random.integers(0, n, s)
    second = (first + random.integers(1, n + 1, s)) % (n + 1)
    normal = random.normal(size=(s, 3))
    strengths = [10.0 ** random.uniform(-2.0, 2.0, (s, 4)) * (random.uniform(size=(s, 4)) < 0.7) for _ in range(2)]
    springs = Springs(
        first,
        second,
        normal / np.linalg.norm(normal, axis=1)[:, None],
        np.column_stack([radius[first], np.append(radius, 0.0)[second]]),
        *strengths,
    )
    return springs, Bodies(random.normal(size=(n, 3)), radius, per_mass, 2.5 * per_mass / radius**2)


@settings(max_examples=80, deadline=None)
@given(tangle=tangles(), per_time=numbers(0.0, 10.0))
def test_products_and_bounds_agree_with_the_dense_matrix_whatever_the_springs(
    tangle: tuple[Springs, Bodies], per_time: float
) -> None:
    springs, bodies = tangle
    exact = largest(springs, bodies, per_time)
    assert largest_eigenvalue(springs, bodies, per_time) == pytest.approx(exact, rel=0.02, abs=1e-9)
    assert local_bounds(springs, bodies, per_time).max() >= exact * (1.0 - 1e-9)


def test_the_limit_has_the_same_bits_in_every_call() -> None:
    _, springs, bodies = pressed(1, 0.5, 0.5)
    assert {largest_eigenvalue(springs, bodies, 1e6).hex() for _ in range(3)} == {
        largest_eigenvalue(springs, bodies, 1e6).hex()
    }


@pytest.mark.parametrize("name", discover().names("integrator"))
@settings(max_examples=40, deadline=None)
@given(zeta=numbers(0.0, 3.0))
def test_one_damped_oscillator_has_the_limit_its_integrator_promises(name: str, zeta: float) -> None:
    """Where what damping costs depends on the damping ratio, as with several stages, the limit is a safe one."""
    scheme = discover().get("integrator", name).part
    promised = 2.0 / 5.0 * scheme.damping_factor(zeta)
    found = stable_step(lambda per_time: 25.0 + 2.0 * zeta * 5.0 * per_time, scheme.damping_factor)
    assert found <= promised * 1.005
    assert found >= promised * (0.99 if len(scheme.stages) == 1 else 0.4)


def test_dashpots_count_in_every_mode_and_not_only_in_a_pair() -> None:
    midstep = discover().get("integrator", "midstep").part.damping_factor
    beta, fastest = 0.01, 100.0
    found = stable_step(lambda per_time: fastest**2 * (1.0 + beta * per_time), midstep)
    assert found == pytest.approx(2.0 / fastest * midstep(0.5 * beta * fastest), rel=0.01)
    assert sensitivity(midstep) == pytest.approx(4.0)


@pytest.mark.parametrize("restitution", [1.0, 0.5, 0.0])
def test_a_law_s_response_is_measured_from_its_loads(restitution: float) -> None:
    law = discover().get("contact_law", "hertz_mindlin").part
    found = contact(GLASS._replace(restitution=restitution))
    response = respond(law, found.constants, found.choices, 1e-4, 1e-9)
    c = found.constants
    beta = {1.0: 0.0, 0.5: np.log(2.0) / np.hypot(np.pi, np.log(2.0)), 0.0: 1.0}[restitution]
    assert response.across == pytest.approx(4.0 * c.G / c.E, rel=1e-6)
    assert response.damping_along == pytest.approx(sqrt(5.0 / 6.0) * beta, rel=1e-6, abs=1e-9)
    assert response.damping_across == pytest.approx(sqrt(5.0 / 6.0) * beta * sqrt(response.across), rel=1e-6, abs=1e-9)


def test_an_impact_lasts_as_long_as_hertz_says() -> None:
    k, m, v = 4.0e6, 1e-9, 0.7
    expected = 2.9432 * (5.0 * m / (4.0 * k)) ** 0.4 * v**-0.2
    assert impact_duration(lambda x: 0.4 * k * x**2.5, m, v, 1e-4) == pytest.approx(expected, rel=1e-3)


def test_the_contact_limit_is_that_of_the_shortest_impact_at_the_rule_s_speed() -> None:
    steel = {"density": 7800, "young_modulus": 2e11, "poisson_ratio": 0.3}
    data = {
        "materials": {"steel": steel},
        "particles": {
            "type": "explicit",
            "material": "steel",
            "particles": [{"position": [x, 0, 0], "radius": r} for x, r in ((0, 1e-3), (1, 1e-2))],
        },
        "contacts": {"law": "hertz_mindlin", "pairs": {"default": {"restitution": 0.9}}},
        "walls": {"floor": {"type": "plane", "material": "steel", "point": [0, 0, -1], "normal": [0, 0, 1]}},
        "time": {"step": {"rule": "spectral", "impact_speed": 2.0}, "end": {"time": 1.0}},
    }
    scene = build_scene(from_mapping(data))
    m = 7800 * 4.0 / 3.0 * np.pi * 1e-9
    E_star = 2e11 / (2.0 * (1.0 - 0.3**2))
    pairs = [(0.5e-3, 0.5 * m), (1e-3, m)]  # two equal spheres; one and the floor
    shortest = min(
        2.9432 * (5.0 * m_star / (4.0 * 4.0 / 3.0 * E_star * sqrt(R))) ** 0.4 * 2.0**-0.2 for R, m_star in pairs
    )
    assert contact_limit(scene) == pytest.approx(0.05 * shortest, rel=1e-3)
