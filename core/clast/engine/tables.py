"""Fills the tables of the step loop from plain arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.engine.blueprint import BondPlan
from clast.engine.kernels.layout import (
    INDEX,
    INTACT,
    INVERSE_INERTIA,
    INVERSE_MASS,
    LANES,
    MATERIAL,
    RADIUS,
    Q,
    V,
    W,
    X,
)
from clast.engine.records import columns, width
from clast.engine.slots_text import bond_offsets
from clast.engine.state import Bonds, Cracks, Floats, Integers, Pairs, Particles, WallPairs


def particle_tables(
    position: Floats,
    radius: Floats,
    mass: Floats,
    velocity: Floats,
    spin: Floats,
    material: Integers,
    prescribed: NDArray[np.bool_],
) -> Particles:
    """Return the tables of n particles: (n, 3) positions, velocities and spins, (n,) all else, SI.

    Prescribed particles get no inverse mass and inertia, so nothing changes their velocity and spin.
    """
    n = len(position)
    pose, twist, body = np.zeros((n, 8)), np.zeros((n, 8)), np.zeros((n, 4))
    pose[:, X : X + 3] = position
    pose[:, RADIUS] = radius
    pose[:, Q] = 1.0
    free = ~prescribed
    twist[:, V : V + 3] = velocity
    twist[:, W : W + 3] = spin
    body[:, MATERIAL] = material
    body[free, INVERSE_MASS] = 1.0 / mass[free]
    body[free, INVERSE_INERTIA] = 2.5 / (mass[free] * radius[free] ** 2)
    return Particles(
        pose,
        twist,
        body,
        seen=twist.copy(),
        load=np.zeros((n, 8)),
        acceleration=np.zeros((n, 8)),
        reference=np.zeros((n, 4)),
        present=np.ones(n, np.uint8),
    )


def bond_table(plan: BondPlan, ends: Integers, reference: Any, constants: Any, start: Any, damping: Floats) -> Bonds:
    """Return the blocked table of m bonds, ordered by their ends.

    Parameters
    ----------
    plan : BondPlan
    ends : (m, 2) int64
    reference, constants, start : records of numbers or (m, ...) arrays
        Undeformed bond, constants of the law, start of the kinematics (None when it has no state).
    damping : (m, 4) float64
        Dashpot coefficients; ignored unless the plan has damping.
    """
    m = len(ends)
    at = bond_offsets(plan)
    blocks = -(-m // LANES)
    order = np.lexsort((ends.max(axis=1), ends.min(axis=1)))
    lanes = np.concatenate([order, np.full(blocks * LANES - m, order[-1])])
    values = np.zeros((m, at["end"]))
    values[:, INTACT] = 1.0
    _put(values, at["reference"], columns(reference, m))
    _put(values, at["constants"], columns(constants, m)[:, ~np.array(plan.uniform, bool)])
    if plan.damping:
        _put(values, at["damping"], damping)
    if start is not None:
        _put(values, at["kinematic_state"], columns(start, m))
    data = values[lanes].reshape(blocks, LANES, -1).transpose(0, 2, 1)
    data = np.ascontiguousarray(data)
    data[-1, INTACT, LANES - (blocks * LANES - m) :] = 0.0
    first = ends[lanes, 0].astype(np.uint32).reshape(blocks, LANES)
    second = ends[lanes, 1].astype(np.uint32).reshape(blocks, LANES)
    return Bonds(first, second, lanes.reshape(blocks, LANES), data.reshape(blocks, -1))


def _put(table: Floats, first: int, block: Floats) -> None:
    table[:, first : first + block.shape[1]] = block


def no_bonds() -> Bonds:
    """Return an empty bond table."""
    ends = np.zeros((0, LANES), np.uint32)
    return Bonds(ends, ends.copy(), np.zeros((0, LANES), np.int64), np.zeros((0, 2 * LANES)))


def slot_view(bonds: Bonds, slot: int) -> Floats:
    """Return a writable view of one slot of the bond table, (b, LANES)."""
    return bonds.data.reshape(len(bonds.first), bonds.data.shape[1] // LANES, LANES)[:, slot, :]


def bond_slot(bonds: Bonds, slot: int) -> Floats:
    """Return one slot of all bonds as (m,) float64, by bond number."""
    real = _real_lanes(bonds)
    values = slot_view(bonds, slot).ravel()
    result = np.zeros(len(real))
    result[bonds.number.ravel()[real]] = values[real]
    return result


def intact(bonds: Bonds) -> NDArray[np.bool_]:
    """Return which bonds still hold, (m,) by bond number; fading ones no longer count."""
    return np.equal(bond_slot(bonds, INTACT), 1.0)


def failure_index(bonds: Bonds) -> Floats:
    """Return the failure index of the last evaluation, (m,) by bond number."""
    return bond_slot(bonds, INDEX)


def _real_lanes(bonds: Bonds) -> Integers:
    """Return the places of real bonds; padding lanes repeat the last one."""
    number = bonds.number.ravel()
    m = 0 if len(number) == 0 else int(number.max()) + 1
    return np.arange(m)


def empty_pairs(history: type | None) -> Pairs:
    """Return an empty list of pairs."""
    none = np.zeros(0, np.uint32)
    row = 3 + width(history) if history else 0
    return Pairs(none, none.copy(), np.zeros(0, np.int64), np.zeros(0), np.zeros(0, np.uint8), np.zeros((0, row)))


def empty_wall_pairs(history: type | None) -> WallPairs:
    """Return an empty list of particles near walls."""
    none = np.zeros(0, np.uint32)
    row = 3 + width(history) if history else 0
    return WallPairs(none, none.copy(), np.zeros(0, np.uint8), np.zeros((0, row)))


def crack_table(bonds: int) -> Cracks:
    """Return an empty crack table with room for every bond."""
    return Cracks(
        np.zeros(1, np.int64),
        np.zeros(bonds, np.int64),
        np.zeros(bonds, np.int64),
        np.zeros((bonds, 2), np.int64),
        np.zeros((bonds, 3)),
        np.zeros(bonds, np.int64),
        np.zeros((bonds, 3)),
    )
