"""Bond models and kinematics give the same bits compiled and in plain Python."""

from __future__ import annotations

import numpy as np
import pytest

from clast.maths.counter_random import uniform
from clast.maths.rotation import turn
from clast.parts.bond_kinematics import BondMotion
from clast.parts.bond_model import BondLoad
from clast.plugins.discovery import discover
from clast.testing.bond_bits import compiled_alike
from clast.testing.bonds import Bond
from clast_plugins.bond_kinematics import incremental, total
from tests.support.bits import assert_same_bits, random_directions, random_rotations
from tests.support.bonds import GEOMETRY, L0, WRITTEN, law

COUNT = 2000


@pytest.mark.parametrize(
    "name",
    [
        "elastic",
        "timoshenko",
        "mohr_coulomb",
        "cohesive",
        "elastic_plastic, K",
        "micro_cracking",
        "elastic_plastic, fibre",
        "micro_cracking, fibre",
    ],
)
def test_a_bond_model_gives_the_same_bits(name):
    model, constants, start = law(name)
    compiled_alike(Bond(model, None, constants, start, size=0.004), COUNT)


def test_every_registered_bond_model_is_compared():
    assert {part for part, _ in WRITTEN.values()} == set(discover().names("bond_model"))
    assert float(GEOMETRY.L0) == L0


def total_sweep(d, q_i, q_j, n0, loads, out):
    nothing = (0.0, 0.0, 0.0)
    for k in range(len(d)):
        a, p, q, n, f = d[k], q_i[k], q_j[k], n0[k], loads[k]
        motion = BondMotion(
            (a[0], a[1], a[2]), (p[0], p[1], p[2], p[3]), (q[0], q[1], q[2], q[3]), nothing, nothing, nothing
        )
        strain, frame, _ = total.measure(motion, total.Reference((n[0], n[1], n[2]), 1.3), None, 0.0)
        load = BondLoad(f[0], (f[1], f[2], f[3]), f[4], (f[5], f[6], f[7]))
        ends = total.end_loads(load, frame)
        out[k, 0], out[k, 1] = strain.axial, strain.twist
        out[k, 2], out[k, 3], out[k, 4] = strain.shear
        out[k, 5], out[k, 6], out[k, 7] = strain.bending
        out[k, 8], out[k, 9], out[k, 10] = ends.force
        out[k, 11], out[k, 12], out[k, 13] = ends.moment_i
        out[k, 14], out[k, 15], out[k, 16] = ends.moment_j


def test_total_kinematics_give_the_same_bits():
    draw = np.random.default_rng(8)
    n0 = random_directions(draw, COUNT)
    d, q_i, q_j = draw.normal(size=(COUNT, 3)), random_rotations(draw, COUNT), random_rotations(draw, COUNT)
    d[:100], q_i[:100], q_j[:200] = 1.3 * n0[:100], (1.0, 0.0, 0.0, 0.0), q_i[:200]
    functions = [total.measure, total.end_loads]
    assert_same_bits(total_sweep, functions, COUNT, 17, d, q_i, q_j, n0, draw.normal(size=(COUNT, 8)))


def incremental_sweep(d, v, w_i, w_j, first, out):
    state = first
    still = (1.0, 0.0, 0.0, 0.0)
    for k in range(len(d)):
        a, b, p, q = d[k], v[k], w_i[k], w_j[k]
        motion = BondMotion(
            (a[0], a[1], a[2]), still, still, (b[0], b[1], b[2]), (p[0], p[1], p[2]), (q[0], q[1], q[2])
        )
        strain, frame, state = incremental.measure(motion, incremental.Reference(1.3), state, 0.01)
        load = BondLoad(strain.axial, strain.shear, strain.twist, strain.bending)
        ends = incremental.end_loads(load, frame)
        out[k, 0], out[k, 1], out[k, 2] = ends.force
        out[k, 3], out[k, 4], out[k, 5] = ends.moment_i
        out[k, 6], out[k, 7], out[k, 8] = ends.moment_j
        out[k, 9], out[k, 10], out[k, 11] = state.e1


def test_incremental_kinematics_give_the_same_bits():
    draw = np.random.default_rng(9)
    d = np.array([1.3, 0.0, 0.0]) + np.cumsum(0.01 * draw.normal(size=(COUNT, 3)), axis=0)
    state = incremental.State((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), 0.0, 0.0, 0.0, 0.0, 0.0)
    motions = (draw.normal(size=(COUNT, 3)) for _ in range(3))
    functions = [incremental.measure, incremental.end_loads]
    assert_same_bits(incremental_sweep, functions, COUNT, 12, d, *motions, state)


def maths_sweep(q, spin, owners, out):
    for k in range(len(q)):
        a, w = q[k], spin[k]
        out[k, 0], out[k, 1], out[k, 2], out[k, 3] = turn((a[0], a[1], a[2], a[3]), (w[0], w[1], w[2]), 0.3)
        out[k, 4] = uniform(int(owners[k, 0]), int(owners[k, 1]), int(owners[k, 2]), int(owners[k, 3]))


def test_turning_and_random_numbers_give_the_same_bits():
    draw = np.random.default_rng(10)
    owners = draw.integers(0, 2**32, (COUNT, 4))
    owners[:, 1] = draw.integers(0, 2**40, COUNT)
    q, spin = random_rotations(draw, COUNT), draw.normal(size=(COUNT, 3))
    assert_same_bits(maths_sweep, [turn, uniform], COUNT, 5, q, spin, owners)
