"""Contact laws and walls give the same bits compiled and in plain Python."""

from __future__ import annotations

import numpy as np
import pytest

from clast.parts.contact_law import Touch
from clast_plugins.contact_laws.hertz_mindlin import History, energy, load
from clast_plugins.walls import cylinder, disc, plane
from tests.support.bits import assert_same_bits, random_directions
from tests.support.contacts import contact

COUNT = 2000


def sweep_of(choices):
    """Return a loop over contacts; the choices are constants of it, as in the step loop."""

    def sweep(numbers, constants, out):
        for k in range(len(numbers)):
            r = numbers[k]
            touch = Touch(
                r[0], (r[1], r[2], r[3]), (r[4], r[5], r[6]), (r[7], r[8], r[9]), (r[10], r[11], r[12]),
                r[13], r[14], r[15], r[16], r[17], (r[21], r[22], r[23]),
            )  # fmt: skip
            history = History((r[18], r[19], r[20]))
            out[k, 12] = energy(touch, constants, history, choices)
            told, after = load(touch, constants, history, 1e-7, choices)
            out[k, 0], out[k, 1], out[k, 2] = told.force
            out[k, 3], out[k, 4], out[k, 5] = told.torque_i
            out[k, 6], out[k, 7], out[k, 8] = told.torque_j
            out[k, 9], out[k, 10], out[k, 11] = after.xi

    return sweep


def random_touches() -> np.ndarray:
    """Return the numbers of random contacts; the first ones neither slide nor spin."""
    draw = np.random.default_rng(11)
    rows = np.empty((COUNT, 24))
    rows[:, 0] = 10.0 ** draw.uniform(-9.0, -5.0, COUNT)
    rows[:, 1:4] = random_directions(draw, COUNT)
    rows[:, 4:7] = draw.normal(size=(COUNT, 3))
    rows[:, 7:13] = 100.0 * draw.normal(size=(COUNT, 6))
    rows[:, 13:16] = draw.uniform(1e-5, 1e-3, (COUNT, 3))
    rows[:, 16] = 10.0 ** draw.uniform(6.0, 10.0, COUNT)
    rows[:, 17] = 10.0 ** draw.uniform(12.0, 18.0, COUNT)
    slip = 1e-7 * draw.normal(size=(COUNT, 3))
    rows[:, 18:21] = slip - (slip * rows[:, 1:4]).sum(axis=1)[:, None] * rows[:, 1:4]
    rows[:, 21:] = 1e-7 * rows[:, 4:7]
    rows[:100, 4:13] = rows[:100, 21:] = 0.0
    rows[:50, 18:] = 0.0
    return rows


@pytest.mark.parametrize(
    "options",
    [{}, {"coulomb_limit": "musen"}, {"coulomb_limit": "total", "tension_cutoff": True, "tangential_memory": "force"}],
)
def test_the_contact_law_gives_the_same_bits(options):
    law = contact(**options)
    assert_same_bits(sweep_of(law.choices), [load, energy], COUNT, 13, random_touches(), law.constants)


def walls_sweep(points, plate, infinite, tube, out):
    for k in range(len(points)):
        x = (points[k, 0], points[k, 1], points[k, 2])
        a, b, c = disc.nearest(plate, x), plane.nearest(infinite, x), cylinder.nearest(tube, x)
        out[k, 0], out[k, 1], out[k, 2] = a.distance, b.distance, c.distance
        out[k, 3], out[k, 4], out[k, 5] = a.normal
        out[k, 6], out[k, 7], out[k, 8] = b.normal
        out[k, 9], out[k, 10], out[k, 11] = c.normal


def test_walls_give_the_same_bits():
    points = np.random.default_rng(12).normal(size=(COUNT, 3))
    points[0] = 0.0
    n = (0.6, 0.0, 0.8)
    plate, infinite = disc.Shape((0.0, 0.0, 0.0), n, 0.7), plane.Shape((0.1, 0.2, 0.3), n)
    tube = cylinder.Shape((0.0, 0.0, 0.0), n, 1.1, 1.0)
    assert_same_bits(
        walls_sweep, [disc.nearest, plane.nearest, cylinder.nearest], COUNT, 12, points, plate, infinite, tube
    )
