"""Spheres that stick: the pull that parts them, and impacts slower and faster than the speed of sticking."""

from __future__ import annotations

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Findings
from clast.verification.closed_forms.adhesion import StickySpheres
from clast.verification.closed_forms.hertz import HertzImpact
from clast.verification.curves import Floats
from clast.verification.finding import Finding, worst
from clast.verification.impact_runs import STARTS, between, motion, on_floor, overlap_with_floor
from clast.verification.reading import follow, force, position
from clast.verification.sketch import Line, Sketch

FALLING, ANCHOR, PULLED = range(4), 4, 5
"""Particles of the scene: those that hit the floor, one too heavy to be moved, and one that is pulled off it."""

SMOOTH, SNAP, REBOUND, CLOSURE = 1e-4, 2e-3, 1e-2, 1e-4
"""Accepted errors: of the largest pull; of where the neck snaps, known to a step of the pull; of v'/v, whose
force jumps at both ends of the contact; of the ledger as a share of what it turned over."""


def judge(bench: Bench) -> Findings:
    """Compare the pull and its end, what sticks, and the rebound of what does not: the worst of four starts."""
    start = bench.start()
    courses = [bench.start({"time.step": start.dt / each}) for each in STARTS]
    pulls = [follow(each, lambda s: (gap(s), float(force(s)[ANCHOR, 2]))) for each in courses]
    pair = sticky(start, between(start, ANCHOR, PULLED))
    yield worst(Finding("largest pull, N", pair.pull_off, float(f.max()), SMOOTH) for _, f in pulls)
    yield worst(Finding("gap of the snap, m", pair.distance, float(d[f > 0.0].max()), SNAP) for d, f in pulls)
    for i in FALLING:
        closed, speed = sticky(start, on_floor(start, i)), -float(start.scene.velocity[i, 2])
        if speed < closed.sticking_speed:
            held = [float(-overlap_with_floor(each, i) < closed.distance) for each in courses]
            yield worst(Finding(f"held at {speed:g} m/s (1: yes)", 1.0, each, 0.0) for each in held)
        else:
            ends = [-float(motion(each).across[i]) / speed for each in courses]
            expected = closed.restitution(speed)
            yield worst(Finding(f"v'/v at {speed:g} m/s", expected, each, REBOUND) for each in ends)
    closures = [each.ledger().closure for each in courses]
    yield worst(Finding("error of the ledger over its turnover", 0.0, each, CLOSURE, True) for each in closures)
    yield curve(pair, *pulls[0])


def sticky(simulation: Simulation, impact: HertzImpact) -> StickySpheres:
    """Return the closed form of bodies whose impact without adhesion is known."""
    assert simulation.config.contacts is not None
    w = float(getattr(simulation.config.contacts.law.params, "work_of_adhesion"))  # noqa: B009
    return StickySpheres(impact.modulus, impact.radius, w, impact.mass)


def gap(simulation: Simulation) -> float:
    """Return how far apart the undeformed surfaces of the pulled pair are, in m."""
    z, radius = position(simulation)[:, 2], simulation.scene.radius
    return float(z[PULLED] - z[ANCHOR] - radius[PULLED] - radius[ANCHOR])


def curve(closed: StickySpheres, gaps: Floats, pulls: Floats) -> Sketch:
    """Show the pull over the gap, both in units of their ends."""
    E, R, w = closed.modulus, closed.radius, closed.adhesion
    a = np.cbrt(np.pi * w * R * R / (8.0 * E)) * np.linspace(1.0, 3.5, 100)
    distance = np.sqrt(2.0 * np.pi * w * a / E) - a * a / R
    pull = np.sqrt(8.0 * np.pi * w * E * a**3) - 4.0 * E * a**3 / (3.0 * R)
    shown = slice(0, None, max(1, len(gaps) // 60))
    lines = (
        Line("closed form", distance / closed.distance, pull / closed.pull_off),
        Line("Clast", gaps[shown] / closed.distance, pulls[shown] / closed.pull_off, dots=True),
    )
    return Sketch("jkr: spheres pulled apart", "gap / gap of the snap", "pull / largest pull", lines)


CASE = Case(
    "sticky_spheres",
    "elastic spheres that stick: pull-off, sticking, restitution",
    "contact_jkr",
    judge,
    "3/2 π w R* and 3/4 (π² w² R*/E*²)^(1/3): Johnson, Kendall and Roberts (1971), doi:10.1098/rspa.1971.0141; "
    "√(1 − v_s²/v²), v_s = √(14.18/m*) (w⁵ R*⁴/E*²)^(1/6): Thornton and Ning (1998), "
    "doi:10.1016/S0032-5910(98)00099-0",
    (needs.law_parameters("work_of_adhesion"), needs.losses),
)
