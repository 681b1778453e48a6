"""The virial of a scene: what its bonds and contacts do to its mean stress; computed when asked, changing nothing."""

from __future__ import annotations

import numpy as np

from clast.engine.compiler import compiled, inlined, routine
from clast.engine.state import Floats, World
from clast.maths.vec3 import Vec, scale

from .bond_dashpots import damped
from .bond_lane import gather as gather_ends
from .bond_lane import read_motion
from .contact_sweep import joined, meet
from .energies import SINCE_FORCES
from .lanes import vector
from .layout import BOND_SCRATCH, FIRST, INTACT, LANES, D
from .network import FREE_LANES, touch_of_pair
from .slots import (
    BOND_DAMPING,
    BONDED_PAIRS_TOUCH,
    BONDS,
    CONTACTS,
    bond_end_loads,
    bond_flow,
    bond_load,
    bond_measure,
    read_bond_state,
    read_constants,
    read_kinematic_state,
    read_reference,
    read_uniforms,
)


@compiled
def virial(world: World, moving: bool, found: Floats) -> None:
    """Add −Σ d ⊗ F over all bonds and contacts to ``found``, at the present positions.

    Parameters
    ----------
    world : World
    moving : bool
        Whether a step was taken; else nothing has moved since the forces.
    found : (3, 3) float64
        In N m: way d from one particle to the nearest image of the other, force F on the other; tension is positive.
    """
    time = SINCE_FORCES * world.numbers.dt if moving else 0.0
    if CONTACTS:
        add_pairs(world, np.empty(FREE_LANES), time, found)
    if BONDS:
        add_bonds(world, np.empty(BOND_SCRATCH * LANES), time, found)


@routine
def add_pairs(world: World, scratch: Floats, time: float, found: Floats) -> None:
    """Add what touching pairs do."""
    pairs = world.pairs
    for k in range(len(pairs.first)):
        counts = meet(world.particles, pairs, k, world.numbers, scratch, 0) and pairs.sides[k] & FIRST != 0
        if not BONDED_PAIRS_TOUCH:
            counts = counts and not joined(pairs, world.bonds, k)
        if counts:
            _, load = touch_of_pair(world, k, scratch, time)
            add_outer(vector(scratch, D, 0), load.force, found)


@routine
def add_bonds(world: World, scratch: Floats, time: float, found: Floats) -> None:
    """Add what bonds do; those that let go slowly count with the share of load they have left."""
    bonds = world.bonds
    uniforms = read_uniforms(world.numbers.bond_uniforms)
    for b in range(len(bonds.first)):
        data = bonds.data[b]
        for lane in range(LANES):
            share = data[INTACT * LANES + lane]
            if share == 0.0 or not bonds.sides[b, lane] & FIRST:
                continue
            gather_ends(world.particles, bonds.first[b, lane], bonds.second[b, lane], scratch, lane)
            motion = read_motion(scratch, lane)
            strain, frame, _ = bond_measure(motion, read_reference(data, lane), read_kinematic_state(data, lane), time)
            constants = read_constants(uniforms, data, lane)
            state = bond_flow(strain, constants, read_bond_state(data, lane))
            ends = bond_end_loads(bond_load(strain, constants, state), frame)
            if BOND_DAMPING:
                ends = damped(ends, motion.d, scratch, data, lane)
            add_outer(motion.d, scale(share, ends.force), found)


@inlined
def add_outer(d: Vec, force: Vec, found: Floats) -> None:
    """Subtract d ⊗ F."""
    for a in range(3):
        for c in range(3):
            found[a, c] -= d[a] * force[c]
