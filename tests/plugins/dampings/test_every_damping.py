"""Every damping: it takes energy and gives none, and the step it promises is stable and not wasted."""

from math import inf

import pytest

from clast.config.scene import from_mapping
from clast.parts.damping import Damping
from clast.parts.params import Params
from clast.plugins.discovery import discover
from clast.simulation import Simulation
from clast.testing.damping import added
from clast.testing.kit import try_part

each = pytest.mark.parametrize("name", discover().names("damping"))
scheme = pytest.mark.parametrize("integrator", ["midstep", "leapfrog", "velocity_verlet", "symplectic_euler"])


def part(name: str) -> Damping:
    return discover().get("damping", name).part


@each
def test_it_keeps_to_what_holds_for_every_damping(name):
    outcomes = try_part(discover().get("damping", name))
    assert [outcome for outcome in outcomes if not outcome.passed] == []


def farthest(damping: Damping, params: Params, integrator: str, h: float) -> float:
    """Return how far from rest x'' = −x comes in 600 steps under a damping, from several starts."""
    stages = discover().get("integrator", integrator).part.stages
    told, most = damping.numbers(params), 0.0
    for x, v in ((1.0, 0.0), (0.3, -0.8), (-0.1, 1.0), (0.7, 0.7)):
        a = -x
        for _ in range(600):
            for stage in stages:
                v += stage.kick_before * a * h
                x += stage.drift_before * v * h
                seen = v + stage.predict * a * h if damping.steering is None else v
                a = -x
                a += added(damping, told, [(a, 0.0, 0.0)], [(seen, 0.0, 0.0)], h)[0][0]
                v += stage.kick_after * a * h
                x += stage.drift_after * v * h
            most = max(most, abs(x))
            if most > 1e6:
                return inf
    return most


@scheme
@pytest.mark.parametrize(
    ("name", "given"), [*(("local", {"factor": factor}) for factor in (0.1, 0.4, 0.7, 0.8)), ("fire", {})]
)
def test_a_damping_leaves_the_step_it_promises_and_little_more(integrator, name, given):
    damping = part(name)
    params = damping.Params(**given)
    limit = 2.0 * damping.step_share(params)
    assert farthest(damping, params, integrator, 0.98 * limit) < 10.0
    assert farthest(damping, params, integrator, 1.05 * limit) == inf


def test_the_limit_of_a_scene_takes_it_into_account():
    places = [[0.0, 0.0, 0.0], [0.0, 0.0, 2e-3]]
    scene = from_mapping(
        {
            "materials": {"glass": {"density": 2500, "young_modulus": 1e9, "poisson_ratio": 0.2}},
            "particles": {
                "type": "explicit",
                "material": "glass",
                "particles": [{"position": x, "radius": 1e-3} for x in places],
                "bonds": [{"between": [0, 1], "diameter": 1e-3}],
            },
            "bonds": {"model": {"type": "elastic", "young_modulus": 1e9, "poisson_ratio": 0.2, "normal_strength": 1e9}},
            "time": {"end": {"steps": 1}},
        }
    )
    free = Simulation(scene)
    damped = Simulation(scene.changed({"damping": {"type": "local", "factor": 0.44}}))
    assert damped.limits.spectral == pytest.approx(free.limits.spectral / 1.2, rel=1e-9)
    assert damped.dt == pytest.approx(free.dt / 1.2, rel=1e-9)
