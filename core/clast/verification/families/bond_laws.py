"""Bond models beside those of the paper: where they break, what they dissipate, how they creep."""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.bond_curves import Course, Softening
from clast.verification.curves import Floats
from clast.verification.families.bonds import beam_of, model_parameters
from clast.verification.finding import Finding
from clast.verification.prescribed_bonds import Model, courses, judge
from clast.verification.sketch import Line, Sketch

COARSE = 10
"""How many times as long the steps of the second run are."""

STIFF = 1e-8
"""Accuracy of a stress, as a share of the strength, that a strain of 2e-4 reaches, between positions near 5 mm."""

SPENT = 1e-6
"""Accuracy of an energy of fracture, as a share: errors fall with the square of the step."""

TINY = 1e-12
"""A time in s at which bonds are hardly strained; at 0 they have no proportion of opening to sliding."""


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


def judge_cohesive(bench: Bench) -> Findings:
    """Compare stresses and steps of breaking with the law, and what damage takes with the energy of fracture."""
    simulation = bench.start()
    params, beam = model_parameters(simulation.scene), beam_of(simulation.scene)
    law = Softening(
        normal=beam.E,
        shear=beam.G,
        strength=params.tensile_strength,
        shear_strength=params.shear_strength,
        energy=params.fracture_energy,
        shear_energy=params.shear_fracture_energy,
    )

    def normal(course: Course, t: Floats, bond: int) -> Floats:
        strain = course.axial(t)
        return np.asarray(beam.E * strain * np.where(strain > 0.0, law.left(course, np.maximum(t, TINY)), 1.0))

    def shear(course: Course, t: Floats, bond: int) -> Floats:
        return np.asarray(beam.G * course.shear(t) * law.left(course, np.maximum(t, TINY)))

    names = ["opening", "sliding", "torsion", "bending", "opening and torsion", "compression and sliding"]
    model = Model(normal, shear, lambda course, t: law.reached(course, max(t, TINY)), law.strength, STIFF)
    yield from judge(bench, names, model)
    end = simulation.last_step * simulation.dt
    expected = beam.A * sum(float(law.spent(course, end)) for course in courses(simulation))
    step, count = simulation.dt, simulation.last_step
    fine, coarse = (bench.run({"time.step": step * every, "time.end.steps": count // every}) for every in (1, COARSE))
    ledger = fine.ledger()
    yield Finding("all bonds: energy that damage took, J", expected, ledger.plastic, SPENT)
    yield Finding("steps ten times as long: the same, J", expected, coarse.ledger().plastic, COARSE**2 * SPENT)
    yield Finding("work that is neither held nor taken, share", 0.0, ledger.closure, SPENT, True)


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
        Case(
            "bond_cohesive",
            "cohesive bonds: six ways to break one, and the energy that it takes",
            "bond_cohesive",
            judge_cohesive,
            "linear softening; W_n/G_n + W_s/G_s = 1: Camanho and Dávila (2002), NASA/TM-2002-211737",
            (needs.cylinder, needs.bond_parameters("tensile_strength", "fracture_energy", "shear_fracture_energy")),
        ),
    ),
)
