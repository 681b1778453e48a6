"""What results show of the bonds: computed when asked, at the positions of the full step."""

from __future__ import annotations

import numpy as np

from clast.engine.compiler import compiled
from clast.engine.state import Floats, World
from clast.maths.vec3 import norm

from .bond_lane import gather, read_motion
from .layout import BOND_SCRATCH, FIRST, INTACT, LANES
from .slots import (
    BONDS,
    bond_energy,
    bond_failure,
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
def observe(world: World, output: Floats) -> None:
    """Write what every bond carries into ``output``.

    Parameters
    ----------
    world : World
    output : (m, 8) float64
        Row k belongs to bond number k, broken bonds keep zeros: intact, elongation in m, normal force and shear force
        in N, torsion and bending moment in N m, failure index, elastic energy in J.
    """
    if BONDS:
        bonds, particles = world.bonds, world.particles
        scratch = np.empty(BOND_SCRATCH * LANES)
        uniforms = read_uniforms(world.numbers.bond_uniforms)
        for b in range(len(bonds.first)):
            data = bonds.data[b]
            for lane in range(LANES):
                if data[INTACT * LANES + lane] != 1.0 or not bonds.sides[b, lane] & FIRST:
                    continue
                gather(particles, bonds.first[b, lane], bonds.second[b, lane], scratch, lane)
                strain, _, _ = bond_measure(
                    read_motion(scratch, lane),
                    read_reference(data, lane),
                    read_kinematic_state(data, lane),
                    0.0,
                )
                constants = read_constants(uniforms, data, lane)
                state = bond_flow(strain, constants, read_bond_state(data, lane))
                load = bond_load(strain, constants, state)
                row = output[bonds.number[b, lane]]
                row[0] = 1.0
                row[1] = strain.axial
                row[2] = load.normal
                row[3] = norm(load.shear)
                row[4] = load.torsion
                row[5] = norm(load.bending)
                row[6] = bond_failure(strain, load, constants, state)
                row[7] = bond_energy(strain, constants, state)
