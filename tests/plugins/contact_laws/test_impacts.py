"""A sphere against a wall, from touch to parting: restitution and friction in closed form."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from clast.maths.vec3 import Vec, scale
from clast.parts.contact_law import Features, Touch
from tests.support.contacts import GLASS, REST, contact

RADIUS, MASS, SPEED = 1e-3, 4e-6, 0.5
NORMAL = (0.0, 0.0, -1.0)  # from the sphere down to the wall


def touch(overlap: float, approach: float, slide: float = 0.0) -> Touch:
    """Return the contact of a sphere that comes down and moves sideways; the wall moves against it."""
    velocity: Vec = (-slide, 0.0, approach)
    return Touch(overlap, NORMAL, velocity, REST, REST, RADIUS, RADIUS, 0.0, 1.0 / MASS, 2.5 / (MASS * RADIUS**2))


def impact(law, slide: float = 0.0, until: str = "parting") -> np.ndarray:
    """Return overlap, approach velocity and sideways impulse when the overlap is back to 0, or the force is."""

    def force_on_sphere(state: np.ndarray) -> np.ndarray:
        return -np.array(law.load(touch(max(state[0], 0.0), state[1], slide))[0].force)

    def rate(time: float, state: np.ndarray) -> list[float]:
        force = force_on_sphere(state)
        return [state[1], -force[2] / MASS, force[0]]

    def parting(time: float, state: np.ndarray) -> float:
        return float(state[0])

    def letting_go(time: float, state: np.ndarray) -> float:
        return float(force_on_sphere(state)[2]) - 1e-12

    event = {"parting": parting, "letting_go": letting_go}[until]
    event.terminal, event.direction = True, -1.0
    start = [1e-14, SPEED, 0.0]
    return solve_ivp(rate, (0.0, 0.1), start, events=event, rtol=1e-9, atol=[1e-15, 1e-11, 1e-15]).y[:, -1]


def damped(e: float, **options: str | bool):
    return contact(GLASS._replace(restitution=e), Features(True, False, False), **options)


@pytest.mark.parametrize("e", [1.0, 0.9, 0.5, 0.1])
def test_a_sphere_bounces_with_its_coefficient_of_restitution(e):
    _, approach, _ = impact(damped(e))
    assert -approach / SPEED == pytest.approx(e, rel=1e-5)


def test_with_restitution_1_there_is_no_damping_at_all():
    still, leaving = (damped(1.0).load(touch(1e-5, speed))[0].force for speed in (0.0, -1.0))
    assert still == leaving


def test_with_restitution_0_the_sphere_stays_where_it_landed():
    _, approach, _ = impact(damped(0.0))
    assert abs(approach) < 1e-3 * SPEED


def test_restitution_0_is_the_limit_of_small_ones():
    limit, small = (damped(e).load(touch(1e-5, 0.1))[0].force for e in (0.0, 1e-300))
    assert limit == pytest.approx(small, rel=1e-4)


def test_cutting_the_pull_off_leaves_a_larger_restitution_as_documented():
    """Clipped damping raises e = 0.5 to 0.55."""
    _, approach, _ = impact(damped(0.5, tension_cutoff=True), until="letting_go")
    assert -approach / SPEED == pytest.approx(0.55, abs=0.005)


@pytest.mark.parametrize(("limit", "cutoff"), [("elastic", False), ("total", True)])
def test_gross_sliding_takes_the_impulse_of_coulomb(limit, cutoff):
    """Friction takes μ times the momentum that the limiting normal force turns round.

    The viscous part integrates to zero, so the limit ``elastic`` gives μ (1 + e) m v exactly; the limit ``total``
    counts what the pushing force gives until it would pull.
    """
    e, mu = 0.5, 0.1
    pair = GLASS._replace(restitution=e, sliding_friction=mu)
    law = contact(pair, Features(True, True, False), coulomb_limit=limit)
    impulse = impact(law, slide=500.0)[2]
    reached = -impact(damped(e, tension_cutoff=True), until="letting_go")[1] / SPEED if cutoff else e
    assert -impulse == pytest.approx(mu * (1.0 + reached) * MASS * SPEED, rel=1e-4)


@pytest.mark.parametrize("e", [1.0, 0.5, 0.1])
def test_what_slides_through_an_impact_feels_the_friction_of_coulomb_at_every_instant(e):
    """The dashpot is strongest where the limit is lowest, at touch: it must not wind the spring up backwards."""
    mu, slide, steps = 0.4, 1.1, 400000
    law = contact(GLASS._replace(restitution=e, sliding_friction=mu), Features(e < 1.0, True, False))
    elastic = contact(features=Features(False, False, False))
    dt, overlap, approach, xi = 1e-7 / SPEED, 0.0, SPEED, REST
    for _ in range(steps):
        overlap += 0.5 * dt * approach
        if overlap <= 0.0:
            break
        here = touch(overlap, approach, slide)
        told, xi = law.load(here._replace(moved=scale(dt, here.velocity)), xi, dt)
        assert told.force[0] == pytest.approx(mu * abs(elastic.load(here)[0].force[2]), rel=1e-12)
        approach += told.force[2] / MASS * dt
        overlap += 0.5 * dt * approach
    assert approach == pytest.approx(-e * SPEED, rel=0.02)
