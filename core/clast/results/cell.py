"""The cell of a scene that repeats itself in all directions: how far it is stretched, and its mean stress."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from clast.engine.kernels.layout import GROWTH, INVERSE_MASS, PER_SPAN, V, X
from clast.engine.state import Floats
from clast.engine.tables import box_of
from clast.scene.scene import is_logarithmic

if TYPE_CHECKING:
    from clast.simulation import Simulation

STRAIN, STRESS = "cell_strain_{}", "cell_stress_{}_Pa"
COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def cell_columns(simulation: Simulation) -> dict[str, float]:
    """Return the columns of the cell on the curves; none where a direction does not repeat itself."""
    if not simulation.box.periodic.all():
        return {}
    strain, stress = cell_strain(simulation), cell_stress(simulation)
    row = {STRAIN.format(axis): float(strain[c]) for c, axis in enumerate("xyz")}
    return row | {STRESS.format("xyz"[a] + "xyz"[c]): float(stress[a, c]) for a, c in COMPONENTS}


def cell_strain(simulation: Simulation) -> Floats:
    """Return the strains of the box, (3,), in the measure in which they grow evenly."""
    stretch = simulation.box.span / simulation.scene.box.span
    return np.log(stretch) if is_logarithmic(simulation.config) else stretch - 1.0


def cell_stress(simulation: Simulation) -> Floats:
    """Return the mean Cauchy stress of the box, (3, 3) in Pa, tension positive.

    Equation: σ = −1/V (Σ d ⊗ F + Σ m u ⊗ u), symmetric part, over bonds and contacts (way d from one particle to the
    nearest image of the other, force F on the other) and particles (u: velocity less that of the box at their place).

    Source: J. Christoffersen, M. M. Mehrabadi, S. Nemat-Nasser (1981), doi:10.1115/1.3157619; for the kinetic part
    M. P. Allen, D. J. Tildesley (2017), Computer Simulation of Liquids, § 2.4.
    """
    box, particles, found = simulation.box, simulation.world.particles, np.zeros((3, 3))
    simulation.kernel.virial(simulation.world, simulation.step > 0, found)
    table = box_of(particles)
    assert table is not None
    heavy = particles.body[:, INVERSE_MASS] > 0.0
    mass = 1.0 / particles.body[heavy, INVERSE_MASS]
    place, velocity = particles.pose[heavy, X : X + 3], particles.twist[heavy, V : V + 3]
    own = velocity - table[GROWTH] * table[PER_SPAN] * (place - box.middle)
    found -= np.einsum("k,ka,kc->ac", mass, own, own)
    return np.asarray(0.5 * (found + found.T) / box.volume)
