"""The three bond models of the paper: the curves of its Fig. 5, and the step in which each bond breaks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from clast.maths.counter_random import uniform
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.bond_curves import Course, cracking, plastic
from clast.verification.curves import Floats
from clast.verification.families.bonds import beam_of, model_parameters
from clast.verification.finding import Finding
from clast.verification.prescribed_bonds import EVERY, EXACT, Model, judge


def judge_elastic(bench: Bench) -> Findings:
    """Model 1: elastic up to its strengths."""
    simulation = bench.start()
    params, beam = model_parameters(simulation.scene), beam_of(simulation.scene)

    def criterion(course: Course, t: Any) -> Any:
        tension = beam.E * (course.axial(t) + course.bent(t)) / params.normal_strength
        return max(tension, beam.G * (course.shear(t) + course.twisted(t)) / params.shear_strength)

    names = ["tension", "compression", "shear", "torsion", "bending"]
    names += ["tension and bending", "compression and bending", "shear and torsion"]
    model = Model(
        normal=lambda course, t, bond: beam.E * course.axial(t),
        shear=lambda course, t, bond: beam.G * course.shear(t),
        criterion=criterion,
        scale=params.normal_strength,
    )
    yield from judge(bench, names, model)


def breaks_at_a_strain(params: Any) -> Callable[[Course, Any], Any]:
    """Return the criterion of Models 2 and 3."""
    tensile, compressive = params.breakage_strain, params.compressive_break * params.breakage_strain
    return lambda course, t: max(course.axial(t) / tensile, -course.axial(t) / compressive)


def judge_plastic(bench: Bench) -> Findings:
    """Model 2: elastic, then plastic."""
    simulation = bench.start()
    params, beam = model_parameters(simulation.scene), beam_of(simulation.scene)
    limit = params.yield_stress

    def normal(course: Course, t: Floats, bond: int) -> Floats:
        strain = course.axial(t)
        return np.asarray(np.sign(strain) * limit * plastic(beam.E * np.abs(strain) / limit))

    def shear(course: Course, t: Floats, bond: int) -> Floats:
        return np.asarray(limit * plastic(beam.G * course.shear(t) / limit))

    model = Model(normal, shear, breaks_at_a_strain(params), limit)
    yield from judge(bench, ("tension", "compression", "shear"), model)


def judge_cracking(bench: Bench) -> Findings:
    """Model 3: elastic, with a drop at each yield; then the same curve by steps ten times as long."""
    simulation = bench.start()
    params, beam = model_parameters(simulation.scene), beam_of(simulation.scene)
    limit = params.yield_stress

    def shares(bond: int, component: int) -> Floats:
        drawn = np.array([uniform(params.seed, bond, component, k) for k in range(200)])
        return np.asarray(params.weakening_factor * drawn)

    def normal(course: Course, t: Floats, bond: int) -> Floats:
        strain = course.axial(t)
        return np.asarray(np.sign(strain) * limit * cracking(beam.E * np.abs(strain) / limit, shares(bond, 0)))

    def shear(course: Course, t: Floats, bond: int) -> Floats:
        return np.asarray(limit * cracking(beam.G * course.shear(t) / limit, shares(bond, 1)))

    model = Model(normal, shear, breaks_at_a_strain(params), limit)
    yield from judge(bench, ("tension", "compression", "shear"), model)
    step, count = simulation.dt, simulation.last_step
    fine, coarse = (bench.start({"time.step": step * every, "time.end.steps": count // every}) for every in (1, EVERY))
    fine.advance_to(count // 2)
    coarse.advance_to(count // (2 * EVERY))
    difference = np.abs(fine.bond_loads() - coarse.bond_loads())[:, 2:4].max() / (beam.A * limit)
    yield Finding("steps ten times as long: difference of a stress, share", 0.0, float(difference), EXACT, True)


PAPER = "Rotter, Dosta and Düster (2023), Fig. 5"

FAMILY = Family(
    "bond_models",
    "Bond models",
    "Single bonds whose ends move as prescribed: the curves of Models 1 to 3, and the step in which each bond breaks. "
    "A bond breaks in the very step that reaches its criterion, neither sooner nor later.",
    (
        Case(
            "bond_elastic",
            "Model 1: eight ways to load a bond",
            "bond_elastic",
            judge_elastic,
            f"σ = Eε, τ = Gγ; breaks at E (ε + Rθ_b/L) = σ_br or G (γ + Rθ_t/L) = τ_br: {PAPER}, Eqs. 7–8",
            (needs.cylinder, needs.bond_parameters("normal_strength", "shear_strength")),
        ),
        Case(
            "bond_elastic_plastic",
            "Model 2: tension, compression, shear",
            "bond_elastic_plastic",
            judge_plastic,
            f"|σ| = min(E|ε|, σ_y), τ = min(Gγ, σ_y); breaks at ε_max and −K ε_max: {PAPER}, Eqs. 9–11, 13",
            (needs.cylinder, needs.bond_parameters("yield_stress", "breakage_strain", "compressive_break")),
        ),
        Case(
            "bond_micro_cracking",
            "Model 3: tension, compression, shear",
            "bond_micro_cracking",
            judge_cracking,
            f"at the kth yield |σ| drops to η_k σ_y, η_k the kth random number of the bond: {PAPER}, Eqs. 11–13",
            (needs.cylinder, needs.bond_parameters("yield_stress", "weakening_factor", "seed")),
        ),
    ),
)
