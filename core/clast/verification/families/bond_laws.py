"""Bond models beside those of the paper: where they break, what they dissipate, how they creep."""

from __future__ import annotations

from math import ceil
from typing import Any

import numpy as np

from clast.scene.scene import Scene
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.bond_curves import Course, Softening
from clast.verification.closed_forms.creep import Creep
from clast.verification.curves import Floats
from clast.verification.families.bonds import beam_of, model_parameters
from clast.verification.finding import Finding
from clast.verification.prescribed_bonds import Model, courses, judge, shown
from clast.verification.reading import evaluation, follow, force, orientation, position
from clast.verification.sketch import Line, Sketch

COARSE = 10
"""How many times as long the steps of the second run are."""

STIFF = 1e-8
"""Accuracy of a stress, as a share of the strength, that a strain of 2e-4 reaches, between positions near 5 mm."""

SPENT = 1e-6
"""Accuracy of an energy of fracture, as a share: errors fall with the square of the step."""

LOOK = 10
"""Steps between two looks at bonds that creep."""

CREPT, CLOSED = 1e-4, 1e-6
"""Accuracy, as shares: of what creeps in steps of τ/400; of the ledger."""

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


def creeps(scene: Scene) -> dict[str, Creep]:
    """Return what the pairs under loads that stay do, in the order of the scene."""
    beam, tau = beam_of(scene), model_parameters(scene).retardation_time
    mass = 0.5 * float(scene.mass[0])
    inertia = 0.4 * mass * float(scene.radius[0]) ** 2
    pull, torque = (np.linalg.norm(each, axis=1)[1:8:2].tolist() for each in (scene.force, scene.torque))
    return {
        "drawn": Creep(beam.axial, mass, tau, pull[0]),
        "twisted": Creep(beam.torsion, inertia, tau, torque[1]),
        "bent": Creep(beam.bending, inertia, tau, torque[2]),
        "overloaded": Creep(beam.axial, mass, tau, pull[3]),
    }


def crept(simulation: Simulation) -> Floats:
    """Return the strain measures of the pairs drawn, twisted and bent, and the force between the sheared ones."""
    x, q = position(simulation), orientation(simulation)
    turned = 4.0 * np.arcsin(np.linalg.norm(q[[3, 5], 1:], axis=1))  # both ends turn alike, each its own way
    return np.array([x[1, 0] - x[0, 0] - simulation.scene.length[0], *turned, np.linalg.norm(force(simulation)[8])])


def judge_kelvin(bench: Bench) -> Findings:
    """Compare creeping bonds with damped oscillators; then the delay of a break, and what resists steady shear."""
    from scipy.optimize import brentq

    simulation = bench.start()
    scene, beam, dt, expected = simulation.scene, beam_of(simulation.scene), simulation.dt, creeps(simulation.scene)
    params = model_parameters(scene)
    found = follow(simulation, crept, LOOK)
    time = np.linspace(0.0, dt * LOOK * (len(found) - 1), len(found))
    lines: list[Line] = []
    for k, name in enumerate(("drawn", "twisted", "bent")):
        end = expected[name].load / expected[name].stiffness
        wanted, got = np.asarray(expected[name].strain(time) / end, np.float64), found[:, k] / end
        error = float(np.abs(got - wanted).max())
        yield Finding(f"{name}: largest error, share of the elastic strain", 0.0, error, CREPT, True)
        lines += shown(name, 1e6 * time, wanted, got)
    limit = params.normal_strength * beam.A / beam.axial
    late = brentq(lambda t: expected["overloaded"].strain(t) - limit, 0.0, float(time[-1]), xtol=1e-6 * dt)
    step = ceil(late / dt - evaluation(simulation))
    yield Finding("overloaded: step in which it breaks", step, float(simulation.world.cracks.step[0]), 1.0, True)
    speed = float(scene.velocity[9, 2])
    slipped = speed * (time[1:] - (1.0 - evaluation(simulation)) * dt)
    resists = beam.shear * (slipped + params.retardation_time * speed)
    error = float(np.abs(found[1:, 3] / resists - 1.0).max())
    yield Finding("sheared: largest error of the force, share", 0.0, error, CREPT, True)
    yield Finding("work that is neither held nor taken, share", 0.0, simulation.ledger().closure, CLOSED, True)
    yield Sketch("kelvin", "time, µs", "share of the elastic strain", tuple(lines))


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
        Case(
            "bond_kelvin",
            "Kelvin-Voigt bonds: creep, a break with delay, steady shear",
            "bond_kelvin",
            judge_kelvin,
            "m d²e/dt² + k (τ de/dt + e) = F; without inertia e = F/k (1 − exp(−t/τ))",
            (needs.cylinder, needs.bond_parameters("normal_strength", "retardation_time")),
        ),
    ),
)
