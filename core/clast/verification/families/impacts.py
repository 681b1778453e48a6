"""Impacts head-on and on a plane: Chung and Ooi (2011), tests 1 to 3."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.hertz import HertzImpact
from clast.verification.curves import Floats, order, peak, zero
from clast.verification.finding import Finding, worst
from clast.verification.impact_runs import STARTS, Row, between, on_floor, overlap_with_floor, starts
from clast.verification.reading import follow, force, position
from clast.verification.sketch import Line, Sketch

COARSE, FINE = 50, 400
"""Steps per contact at which accuracy is asked for."""

COUNTS = (25, COARSE, 100, 200, FINE, 800)
"""Steps per contact at which the error of a restitution is shown."""

ELASTIC, DAMPED, DAMPED_FINE = 1e-3, 1e-2, 1e-3
"""Accuracy that is asked for: without damping, with damping, and with damping at ``FINE`` steps."""


def overlap_of_pair(simulation: Simulation, i: int) -> float:
    """Return how far the particles i and i + 1 overlap in m; a gap is negative."""
    x, radius = position(simulation), simulation.scene.radius
    return float(radius[i] + radius[i + 1] - np.linalg.norm(x[i + 1] - x[i]))


def judge_pairs(bench: Bench) -> Findings:
    """Compare both pairs of test 1 with Hertz."""
    start = bench.start()
    for name, i in (("limestone", 0), ("glass", 2)):
        yield from judge_contact(bench, name, i, between(start, i, i + 1), overlap_of_pair)


def judge_falls(bench: Bench) -> Findings:
    """Compare both spheres of test 2 with Hertz."""
    start = bench.start()
    for name, i in (("magnesium alloy", 0), ("aluminium", 1)):
        yield from judge_contact(bench, name, i, on_floor(start, i), overlap_with_floor)


def judge_contact(
    bench: Bench, name: str, i: int, closed: HertzImpact, overlap: Callable[[Simulation, int], float]
) -> Findings:
    """Compare peak force, peak overlap and duration of one elastic impact, the worst of four starts each."""
    found = []
    for start in STARTS:
        simulation = bench.start({"time.step": closed.duration / (COARSE * start)})
        overlaps, pushes = follow(simulation, lambda s: (overlap(s, i), float(np.linalg.norm(force(s)[i]))))
        time = simulation.dt * np.arange(float(len(overlaps)))
        touch = -overlaps[0] / closed.speed
        found.append((peak(pushes), peak(overlaps), zero(time, overlaps) - touch))
    quantities = ("peak force, N", "peak overlap, m", "duration, s")
    expected = (closed.peak_force, closed.peak_overlap, closed.duration)
    for quantity, wanted, column in zip(quantities, expected, zip(*found, strict=True), strict=True):
        yield worst(Finding(f"{name}: {quantity}", wanted, got, ELASTIC) for got in column)
    yield course(name, closed, time - touch, overlaps)


def course(name: str, closed: HertzImpact, time: Floats, overlaps: Floats) -> Sketch:
    """Show the overlap during one impact, in units of the closed form's peak and duration."""
    during = overlaps > 0.0
    return Sketch(
        f"{name}: {COARSE} steps per contact",
        "time / duration",
        "overlap / peak overlap",
        (
            Line("Hertz", *closed.course()),
            Line("Clast", time[during] / closed.duration, overlaps[during] / closed.peak_overlap, dots=True),
        ),
    )


def judge_restitution(bench: Bench) -> Findings:
    """Compare v'/v with e at several numbers of steps per contact; each the worst of four starts."""
    row = Row(bench)
    written = row.restitution
    got = np.array([[-after.across / row.before.across for after in starts(row, n)] for n in COUNTS])
    for n, damped in ((COARSE, DAMPED), (FINE, DAMPED_FINE)):
        for e, values in zip(written, got[COUNTS.index(n)].T, strict=True):
            quantity = f"v'/v at e = {e:g}, {n} steps per contact"
            bound = ELASTIC if e in (0.0, 1.0) else damped
            yield worst(Finding(quantity, e, value, bound, absolute=e == 0.0) for value in values)
    yield Sketch(
        "restitution",
        "e",
        "v'/v",
        (Line("v' = e v", written, written), Line(f"Clast, {COARSE} steps", written, got[1, 0], dots=True)),
    )
    yield convergence(written, np.sqrt(np.mean((got - written) ** 2, axis=1)))


def convergence(written: Floats, errors: Floats) -> Sketch:
    """Show the error of each restitution against the number of steps, with the order fitted to it."""
    counts = np.array(COUNTS, float)
    shown = [(e, column) for e, column in zip(written, errors.T, strict=True) if e > 0.0]
    return Sketch(
        "restitution: error against steps",
        "steps per contact",
        "error of v'/v, RMS of four starts",
        tuple(Line(f"e = {e:g}: order {order(COUNTS, column):.1f}", counts, column) for e, column in shown),
        logarithmic=True,
    )


HERTZ = "peak force, peak overlap and duration of Hertz's impact: K. L. Johnson (1985), Contact Mechanics, Sect. 11.4"

FAMILY = Family(
    "impacts",
    "Impacts head-on",
    "Chung and Ooi (2011), tests 1 to 3. Each number is the worst of four impacts that begin at different points of "
    "a step. With damping the force sets in with a kink, which leaves the order 1.25 of convergence to any "
    "integrator.",
    (
        Case("chung_ooi_1", "two equal spheres, elastic", "chung_ooi_1_head_on", judge_pairs, HERTZ, (needs.hertzian,)),
        Case(
            "chung_ooi_2",
            "a sphere on a rigid plane, elastic",
            "chung_ooi_2_on_plane",
            judge_falls,
            HERTZ,
            (needs.hertzian,),
        ),
        Case(
            "chung_ooi_3",
            "restitution from 0 to 1",
            "chung_ooi_3_restitution",
            judge_restitution,
            "v'/v = e, by the damping of Tsuji, Tanaka and Ishida (1992), doi:10.1016/0032-5910(92)88030-L",
            (needs.hertzian, needs.full_restitution),
        ),
    ),
)
