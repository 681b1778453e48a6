"""Bond models beside those of the paper: where they break, what they dissipate, how they creep."""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.bond_curves import Course
from clast.verification.families.bonds import beam_of, model_parameters
from clast.verification.prescribed_bonds import Model, judge
from clast.verification.sketch import Line, Sketch


def judge_mohr_coulomb(bench: Bench) -> Findings:
    """Compare stresses and steps of breaking with the envelope of Mohr and Coulomb, cut off in tension."""
    simulation = bench.start()
    params, beam = model_parameters(simulation.scene), beam_of(simulation.scene)
    beta, friction = params.moment_contribution, np.tan(params.friction_angle)

    def criterion(course: Course, t: Any) -> Any:
        sigma = beam.E * course.axial(t)
        tension = (sigma + beta * beam.E * course.bent(t)) / params.tensile_strength
        tau = beam.G * (course.shear(t) + beta * course.twisted(t))
        return max(tension, (tau + friction * sigma) / params.cohesion)

    names = ["tension", "compression", "shear", "torsion", "bending", "tension and bending"]
    names += ["tension and shear", "some compression and shear", "more compression and shear"]
    model = Model(
        normal=lambda course, t, bond: beam.E * course.axial(t),
        shear=lambda course, t, bond: beam.G * course.shear(t),
        criterion=criterion,
        scale=params.tensile_strength,
    )
    yield from judge(bench, names, model)
    cracks = bench.run().world.cracks
    untwisted = [row for row, bond in enumerate(cracks.bond.tolist()) if names[bond] not in ("torsion", "bending")]
    sigma, tau = 1e-6 * cracks.load[untwisted, :2].T / beam.A
    along = np.array([sigma.min(), 1e-6 * params.tensile_strength])
    envelope = Line("c − σ tan φ", along, 1e-6 * params.cohesion - friction * along)
    yield Sketch("where bonds break", "σ, MPa", "τ, MPa", (envelope, Line("Clast", sigma, tau, dots=True)))


FAMILY = Family(
    "bond_laws",
    "Further bond models",
    "Single bonds of the models beside the paper's, whose ends move as prescribed or that carry a load.",
    (
        Case(
            "bond_mohr_coulomb",
            "parallel bonds: nine ways to load a bond",
            "bond_mohr_coulomb",
            judge_mohr_coulomb,
            "breaks at N/A + β |M_b| R/I = σ_c or |T|/A + β |M_t| R/J = c − N/A tan φ: Potyondy and Cundall (2004), "
            "doi:10.1016/j.ijrmms.2004.09.011",
            (needs.cylinder, needs.bond_parameters("tensile_strength", "cohesion", "friction_angle")),
        ),
    ),
)
