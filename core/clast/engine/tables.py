"""Fills the tables of the step loop from plain arrays."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from clast.engine.blueprint import BondPlan
from clast.engine.chunks import shared_out
from clast.engine.kernels.layout import (
    BOX_ROWS,
    ENGINEERING,
    FIRST,
    GROWTH,
    INDEX,
    INTACT,
    INVERSE_INERTIA,
    INVERSE_MASS,
    LANES,
    LOGARITHMIC,
    MATERIAL,
    MIDDLE,
    PER_SPAN,
    RADIUS,
    SPAN,
    SPAN_AT_SEARCH,
    SPAN_AT_START,
    WEIGHT,
    F,
    M,
    Q,
    V,
    W,
    X,
)
from clast.engine.records import columns
from clast.engine.slots_text import bond_offsets
from clast.engine.state import (
    Bonds,
    Bytes,
    Cracks,
    Floats,
    Indices,
    Integers,
    Pairs,
    Particles,
    RepeatedParticles,
    WallPairs,
)
from clast.maths.box import Box


def particle_tables(
    position: Floats,
    radius: Floats,
    mass: Floats,
    velocity: Floats,
    spin: Floats,
    material: Integers,
    prescribed: NDArray[np.bool_],
    weight: Floats,
    applied: Floats,
) -> Particles:
    """Return the tables of n particles: (n, 3) positions, velocities and spins, (n,) all else, SI.

    ``weight`` is the share of its mass that body forces act on: less than 1 for a particle that was made heavier.
    ``applied`` (n, 6) holds the force and the torque that act on each particle all the time, or has no rows.
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
    body[:, WEIGHT] = weight
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
        applied=_load_rows(applied),
        present=np.ones(n, np.uint8),
    )


def repeated(particles: Particles, box: Box, rates: Floats, logarithmic: bool) -> Particles:
    """Return particles with the table of a box that is stretched at rates (3,) in 1/s of the one strain or the other.

    The particles alone where the box does not repeat itself.
    """
    if not box.repeats:
        return particles
    table = np.zeros((BOX_ROWS, 3))
    table[[SPAN, SPAN_AT_START, SPAN_AT_SEARCH]], table[PER_SPAN] = box.span, box.per_span
    table[LOGARITHMIC if logarithmic else ENGINEERING] = rates
    table[GROWTH] = box.span * rates
    table[MIDDLE] = box.middle
    return cast(Particles, RepeatedParticles(*particles, table))


def box_of(particles: Particles) -> Floats | None:
    """Return the table of the box that particles repeat themselves in; None where they do not."""
    return particles.box if isinstance(particles, RepeatedParticles) else None


def box_now(start: Box, particles: Particles) -> Box:
    """Return the box in which particles repeat themselves as it is now, from that at the start."""
    table = box_of(particles)
    return start if table is None else start.grown(table[SPAN])


def _load_rows(loads: Floats) -> Floats:
    """Return forces and torques, (n, 6), as rows of the particle tables, (n, 8)."""
    rows = np.zeros((len(loads), 8))
    rows[:, F : F + 3], rows[:, M : M + 3] = loads[:, :3], loads[:, 3:]
    return rows


def bond_table(
    plan: BondPlan, chunks: Indices, ends: Integers, reference: Any, constants: Any, start: Any, damping: Floats
) -> Bonds:
    """Return the blocked table of m bonds, chunk after chunk and ordered by their ends.

    Parameters
    ----------
    plan : BondPlan
    chunks : (c + 1,) uint32
        Particle numbers where chunks begin.
    ends : (m, 2) int64
    reference, constants, start : records of numbers or (m, ...) arrays
        Undeformed bond, constants of the law, start of the kinematics (None when it has no state).
    damping : (m, 4) float64
        Dashpot coefficients; ignored unless the plan has damping.
    """
    m = len(ends)
    at = bond_offsets(plan)
    lanes, sides, begin = _lanes(chunks, ends)
    values = np.zeros((m, at["end"]))
    values[:, INTACT] = 1.0
    _put(values, at["reference"], columns(reference, m))
    _put(values, at["constants"], columns(constants, m)[:, ~np.array(plan.uniform, bool)])
    if plan.damping:
        _put(values, at["damping"], damping)
    if start is not None:
        _put(values, at["kinematic_state"], columns(start, m))
    data = np.ascontiguousarray(values[lanes].transpose(0, 2, 1))
    data[:, INTACT][sides == 0] = 0.0
    first, second = np.ascontiguousarray(ends[lanes].astype(np.uint32).transpose(2, 0, 1))
    return Bonds(first, second, lanes, sides, data.reshape(len(lanes), -1), begin)


def _lanes(chunks: Indices, ends: Integers) -> tuple[Integers, Bytes, Indices]:
    """Return the bond of every lane and the ends it loads, (b, LANES), and where each chunk's blocks begin.

    Each chunk fills whole blocks; lanes without a bond of their own repeat one and load nothing.
    """
    order = np.lexsort((ends.max(axis=1), ends.min(axis=1)))
    rows, row_sides, row_begin = shared_out(chunks, ends[order])
    counts = row_begin[1:].astype(np.int64) - row_begin[:-1]
    begin = np.concatenate([[0], np.cumsum(-(-counts // LANES))])
    places = np.arange(len(rows)) + np.repeat(begin[:-1] * LANES - row_begin[:-1], counts)
    lanes, sides = np.zeros(begin[-1] * LANES, np.int64), np.zeros(begin[-1] * LANES, np.uint8)
    lanes[places], sides[places] = order[rows], row_sides
    lanes[sides == 0] = order[-1]
    return lanes.reshape(-1, LANES), sides.reshape(-1, LANES), begin.astype(np.uint32)


def _put(table: Floats, first: int, block: Floats) -> None:
    table[:, first : first + block.shape[1]] = block


def no_bonds(chunks: Indices) -> Bonds:
    """Return an empty bond table."""
    ends = np.zeros((0, LANES), np.uint32)
    sides = np.zeros((0, LANES), np.uint8)
    nothing = np.zeros((0, 2 * LANES))
    return Bonds(ends, ends.copy(), np.zeros((0, LANES), np.int64), sides, nothing, np.zeros_like(chunks))


def slot_view(bonds: Bonds, slot: int) -> Floats:
    """Return a writable view of one slot of the bond table, (b, LANES)."""
    return bonds.data.reshape(len(bonds.first), bonds.data.shape[1] // LANES, LANES)[:, slot, :]


def bond_slot(bonds: Bonds, slot: int) -> Floats:
    """Return one slot of all bonds as (m,) float64, by bond number."""
    real = np.nonzero(bonds.sides.ravel() & FIRST)[0]  # the copy in the first end's chunk stands for the bond
    values = slot_view(bonds, slot).ravel()
    result = np.zeros(len(real))
    result[bonds.number.ravel()[real]] = values[real]
    return result


def take_out(particles: Particles, bonds: Bonds, leaving: NDArray[np.bool_]) -> None:
    """Take particles, (n,) bool, out of a scene: they rest, nothing moves them, and their bonds let go."""
    particles.present[leaving] = 0
    particles.twist[leaving] = particles.acceleration[leaving] = 0.0
    particles.body[leaving, INVERSE_MASS] = particles.body[leaving, INVERSE_INERTIA] = 0.0
    if len(bonds.first):
        slot_view(bonds, INTACT)[leaving[bonds.first] | leaving[bonds.second]] = 0.0


def intact(bonds: Bonds) -> NDArray[np.bool_]:
    """Return which bonds still hold, (m,) by bond number; fading ones no longer count."""
    return np.equal(bond_slot(bonds, INTACT), 1.0)


def failure_index(bonds: Bonds) -> Floats:
    """Return the failure index of the last evaluation, (m,) by bond number."""
    return bond_slot(bonds, INDEX)


def empty_pairs(chunks: Indices, remembered: int) -> Pairs:
    """Return an empty list of pairs."""
    none, flags = np.zeros(0, np.uint32), np.zeros(0, np.uint8)
    return Pairs(
        none,
        none.copy(),
        flags,
        np.zeros(0, np.int64),
        np.zeros(0),
        flags.copy(),
        np.zeros((0, remembered)),
        np.zeros_like(chunks),
        np.zeros_like(chunks[1:]),
    )


def empty_wall_pairs(remembered: int) -> WallPairs:
    """Return an empty list of particles near walls."""
    none = np.zeros(0, np.uint32)
    return WallPairs(none, none.copy(), none.copy(), np.zeros(0, np.uint8), np.zeros((0, remembered)))


def crack_table(chunks: Indices, ends: Integers) -> Cracks:
    """Return an empty crack table with room for every bond, in the chunk of its first end."""
    bonds = len(ends)
    begin = np.searchsorted(np.sort(ends[:, 0]), chunks)
    return Cracks(
        begin,
        np.zeros(len(chunks) - 1, np.int64),
        np.zeros(bonds, np.int64),
        np.zeros(bonds, np.int64),
        np.zeros((bonds, 2), np.int64),
        np.zeros((bonds, 3)),
        np.zeros(bonds, np.int64),
        np.zeros((bonds, 3)),
    )


def crack_rows(cracks: Cracks) -> Integers:
    """Return the rows of the crack table in use, in the order of breaking: by step, then by chunk."""
    rows = np.concatenate(
        [np.arange(begin, begin + filled) for begin, filled in zip(cracks.begin, cracks.filled, strict=False)]
    )
    return np.asarray(rows[np.argsort(cracks.step[rows], kind="stable")])
