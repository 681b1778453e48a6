"""The three bond models of the paper: the curves of its Fig. 5, and the step in which each bond breaks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np

from clast.maths.counter_random import uniform
from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.bond_curves import Course, cracking, plastic
from clast.verification.curves import Floats
from clast.verification.families.bonds import beam_of, model_parameters, split
from clast.verification.finding import Finding
from clast.verification.reading import evaluation, follow
from clast.verification.sketch import Line, Sketch

EXACT = 1e-9
"""Accuracy of a stress, as a share of the strength or the yield stress."""

EVERY = 10
"""Steps between two looks at the stresses."""

SHOWN = ("tension", "shear")
"""Bonds whose curves are shown."""


@dataclass(frozen=True)
class Model:
    """What a bond model promises.

    Attributes
    ----------
    normal, shear : (course, time, bond) -> stress in Pa
        On the axis of the bond, until it breaks.
    criterion : (course, time) -> number
        The bond breaks at 1.
    scale : float
        Strength or yield stress in Pa.
    """

    normal: Callable[[Course, Floats, int], Floats]
    shear: Callable[[Course, Floats, int], Floats]
    criterion: Callable[[Course, Any], Any]
    scale: float

    def stresses(self, course: Course, t: Floats, bond: int) -> Floats:
        """Return both stresses at (k,) times, (k, 2) in Pa."""
        return np.column_stack([self.normal(course, t, bond), self.shear(course, t, bond)])


def courses(simulation: Simulation) -> list[Course]:
    """Return how the ends of every bond of a scene move."""
    scene = simulation.scene
    i, j = scene.ends.T
    axes = scene.bond_vectors / scene.length[:, None]
    slips = [split(v, n) for v, n in zip(scene.velocity[j] - scene.velocity[i], axes, strict=True)]
    turns = [split(w, n) for w, n in zip(scene.spin[j] - scene.spin[i], axes, strict=True)]
    sizes = zip(scene.length, 0.5 * scene.diameter, strict=True)
    return [Course(float(L), float(R), *slip, *turn) for (L, R), slip, turn in zip(sizes, slips, turns, strict=True)]


def step_of_breaking(simulation: Simulation, course: Course, model: Model) -> int:
    """Return the number of the step that first sees the criterion fulfilled; that of the end, where none does."""
    from scipy.optimize import brentq

    end = simulation.last_step * simulation.dt
    if model.criterion(course, end) < 1.0:
        return simulation.last_step
    time = brentq(lambda t: model.criterion(course, t) - 1.0, 0.0, end, xtol=1e-6 * simulation.dt)
    return ceil(time / simulation.dt - evaluation(simulation))


def judge(bench: Bench, names: Sequence[str], model: Model) -> Findings:
    """Compare the stresses of bonds, and the steps in which they break, with what their model promises."""
    simulation = bench.start()
    loads = follow(simulation, Simulation.bond_loads, EVERY)
    time, cracks = simulation.dt * EVERY * np.arange(len(loads)), simulation.world.cracks
    broken = dict(zip(cracks.bond[: simulation.bonds_broken].tolist(), cracks.step.tolist(), strict=False))
    lines: list[Line] = []
    for b, (name, course) in enumerate(zip(names, courses(simulation), strict=True)):
        expected, got = step_of_breaking(simulation, course, model), broken.get(b, simulation.last_step)
        what = "step in which it breaks" if expected < simulation.last_step else "holds to the last step"
        yield Finding(f"{name}: {what}", expected, got, 0.0, absolute=True)
        holds = loads[:, b, 0] > 0.0
        stresses = loads[holds, b, 2:4] / beam_of(simulation.scene).A
        wanted, before = (model.stresses(course, t, b) for t in (time[holds], time[holds] - simulation.dt))
        smooth = np.abs(wanted - before).max(axis=1) < 0.01 * model.scale  # a drop may be due at the next evaluation
        error = float(np.abs(stresses - wanted)[smooth].max()) / model.scale
        yield Finding(f"{name}: largest error of a stress, share of {model.scale:.3g} Pa", 0.0, error, EXACT, True)
        if name in SHOWN:
            strain = course.axial(time[holds]) if name == "tension" else course.shear(time[holds])
            component = SHOWN.index(name)
            lines += shown(name, 100.0 * strain, 1e-6 * wanted[:, component], 1e-6 * stresses[:, component])
    yield Sketch(bench.scene().bonds.model.name, "strain, %", "stress, MPa", tuple(lines))  # type: ignore[union-attr]


def shown(name: str, strain: Floats, wanted: Floats, got: Floats) -> Iterator[Line]:
    """Show a curve of closed form, and every tenth of the stresses that were computed."""
    yield Line(f"{name}, closed form", strain, wanted)
    yield Line(f"{name}, Clast", strain[::10], got[::10], dots=True)


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
