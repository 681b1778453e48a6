"""Impacts with linear springs and dashpots: durations, rebounds, sticking and sliding."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Findings
from clast.verification.closed_forms.linear import LinearImpact, slip_ratio
from clast.verification.closed_forms.sliding import after_sliding
from clast.verification.curves import Floats, zero
from clast.verification.finding import Finding, worst
from clast.verification.impact_runs import STARTS, motion, overlap_with_floor, with_floor
from clast.verification.reading import follow
from clast.verification.sketch import Line, Sketch

HEAD_ON, STICKING, SLIDING = (0, 1, 2), 3, slice(4, 6)
"""Particles of the scene, by what they do."""

STEPS = 400
"""Steps per elastic impact."""

ROUGH = {"contacts.pairs.elastic-rigid.sliding_friction": 1e6, "contacts.law.stiffness_ratio": 0.8}
"""What lets a sphere stick with another tangential stiffness."""

EXACT, DAMPED, WOUND_UP = 1e-4, 5e-3, 2e-2
"""Accuracy that is asked for: of what is smooth; with dashpots, and of a slip whose spring is still wound up when the
contact parts. Both make the force jump, so that these errors fall with the step itself."""


def on_floor(simulation: Simulation, i: int) -> LinearImpact:
    """Return the closed form of particle i and the floor, by the stiffness that the law declares."""
    config, scene = simulation.config, simulation.scene
    assert config.contacts is not None
    law = config.contacts.law
    constants = law.part.constants(law.params, needs.pair_of(config))
    stiffness = law.part.stiffness(constants, float(scene.radius[i]), 1e-6)
    return LinearImpact(stiffness, float(scene.mass[i]), with_floor(simulation, i).restitution)


def judge(bench: Bench) -> Findings:
    """Compare durations and rebounds, what sticks, and what slides; each the worst of four starts."""
    start = bench.start()
    elastic = replace(on_floor(start, 0), restitution=1.0)
    steps = [elastic.duration / (STEPS * each) for each in STARTS]
    courses = [bench.start({"time.step": step}) for step in steps]
    overlaps = [follow(each, lambda s: [overlap_with_floor(s, i) for i in HEAD_ON]) for each in courses]
    for i in HEAD_ON:
        closed, bound = on_floor(start, i), EXACT if on_floor(start, i).restitution == 1.0 else DAMPED
        e = closed.restitution
        times = [duration(each.dt, found[:, i], start) for each, found in zip(courses, overlaps, strict=True)]
        rebounds = [-float(motion(each).across[i]) for each in courses]
        yield worst(Finding(f"e = {e:g}: duration, s", closed.duration, got, bound) for got in times)
        yield worst(Finding(f"e = {e:g}: v'/v", closed.rebound, got, bound) for got in rebounds)
    yield from judge_friction(bench, courses, steps)
    yield course(elastic, courses[0].dt, overlaps[0])


def duration(step: float, overlap: Floats, start: Simulation) -> float:
    """Return how long a sphere touched the floor, from all its overlaps, in s."""
    speed = float(motion(start).across[0])
    return zero(step * np.arange(float(len(overlap))), overlap) + float(overlap[0]) / speed


def judge_friction(bench: Bench, ends: list[Simulation], steps: list[float]) -> Findings:
    """Compare the sphere that sticks with two tangential stiffnesses, and those that slide all through."""
    before = motion(bench.start())
    written = bench.scene().contacts
    assert written is not None
    rough = [bench.run({**ROUGH, "time.step": step}) for step in steps]
    kappa_written = float(getattr(written.law.params, "stiffness_ratio", 0.0))
    both = ((kappa_written, ends, EXACT), (ROUGH["contacts.law.stiffness_ratio"], rough, WOUND_UP))
    for kappa, runs, bound in both:
        left = [float(motion(each).slip[STICKING] / before.slip[STICKING]) for each in runs]
        expected = slip_ratio(kappa)
        yield worst(Finding(f"sticks, κ = {kappa:.3g}: slip'/slip", expected, got, bound) for got in left)
    settings = [with_floor(ends[0], i) for i in range(SLIDING.start, SLIDING.stop)]
    friction, e = (np.array([getattr(each, name) for each in settings]) for name in ("sliding_friction", "restitution"))
    sliding = type(before)(*(each[SLIDING] for each in before))
    closed = after_sliding(sliding, friction, e)
    for k, name in enumerate(f"slides, e = {each:g}" for each in e):
        spins = [float(motion(each).turning[SLIDING][k]) for each in ends]
        yield worst(Finding(f"{name}: rω', m/s", float(closed.turning[k]), got, DAMPED) for got in spins)


def course(closed: LinearImpact, step: float, overlaps: Floats) -> Sketch:
    """Show the overlaps of the spheres that fall head-on, in units of the elastic impact."""
    time = step * np.arange(float(len(overlaps))) + overlaps[0, 0]
    largest = np.sqrt(closed.mass / closed.stiffness)
    phase = np.linspace(0.0, 1.0, 60)
    lines = [Line("e = 1: half a sine", phase, np.sin(np.pi * phase))]
    for i, label in zip(HEAD_ON, ("e = 1", "e = 0.5", "e = 0.2"), strict=True):
        during = overlaps[:, i] > 0.0
        shown = np.nonzero(during)[0][::8]
        lines.append(Line(label, time[shown] / closed.duration, overlaps[shown, i] / largest, dots=True))
    return Sketch("linear: overlap", "time / elastic duration", "overlap / elastic peak", tuple(lines))


CASE = Case(
    "linear_impact",
    "linear spring and dashpot: duration, restitution, sticking, sliding",
    "contact_linear",
    judge,
    "π √(m/k)/√(1 − β²), v'/v = e; slip'/slip = cos(π √(7κ/2)) where it sticks, rω' = 5/2 μ (1 + e) v_n where it "
    "slides: Schäfer, Dippel and Wolf (1996), doi:10.1051/jp1:1996129",
    (
        needs.linear,
        needs.law_parameters("stiffness_ratio"),
        needs.sticks,
        needs.full_restitution,
        needs.coulomb_on_elastic_force,
    ),
)
