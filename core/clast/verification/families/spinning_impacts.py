"""Impacts of spinning spheres: Chung and Ooi (2011), tests 6 to 8."""

from __future__ import annotations

import numpy as np

from clast.simulation import Simulation
from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.hertz import HertzImpact
from clast.verification.finding import Finding, worst
from clast.verification.impact_runs import STARTS, Row, between, with_floor
from clast.verification.oblique import WITH_DAMPING, Measure, answer, compare, convergence, curve
from clast.verification.reading import spin, velocity

ON_PLANE, GEARS, ON_LARGE = slice(0, 13), slice(13, 21), slice(22, None, 2)
"""Particles of tests 6, 7 and 8; of test 8 the small ones, each listed after its large one."""

MEASURES = (
    Measure("β", lambda row, after: -after.slip / row.before.slip, lambda row: np.ones_like(row.radius)),
    Measure(
        "tan of recoil angle",
        lambda row, after: after.slip / after.across,
        lambda row: -row.before.slip / (row.restitution * row.before.across),
    ),
)
"""How much of the slip is reversed, and where the contact point leaves to; errors as shares of 1, and of the tangent
that it would have without friction."""


def angles(row: Row) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Return how far from the normal each contact point comes in, in degrees."""
    return np.degrees(np.arctan(-row.before.slip / row.before.across))


def judge_on_plane(bench: Bench) -> Findings:
    """Compare the spheres that spin on the plane at all angles."""
    row = Row(bench, ON_PLANE)
    exact, angle = answer(row), angles(row)
    yield from compare("", row, exact, MEASURES, WITH_DAMPING, [f"{each:.0f}°" for each in angle])
    for measure in MEASURES:
        yield curve("test 6: on a plane", "angle of impact, °", angle, row, exact, measure)
    yield convergence("test 6: error against steps", row, exact)


def judge_gears(bench: Bench) -> Findings:
    """Compare the pairs that roll on each other, so that nothing tangential must happen."""
    start = bench.start()
    before, turning = velocity(start)[GEARS], spin(start)[GEARS]
    e, duration = with_floor(start, 0).restitution, between(start, GEARS.start, GEARS.start + 1).duration
    for n, bound in WITH_DAMPING.items():
        ends = [bench.run({"time.step": duration / (n * each)}) for each in STARTS]
        after, spins = (np.array([read(each)[GEARS] for each in ends]) for read in (velocity, spin))
        found = (Finding(f"{n} steps: v'/v", e, float(got), bound) for got in np.ravel(-after[..., 0] / before[:, 0]))
        yield worst(found)
        sideways, gained = float(np.abs(after[..., 1:]).max()), float(np.abs(spins - turning).max())
        yield Finding(f"{n} steps: largest tangential velocity, m/s", 0.0, sideways, 0.0, absolute=True)
        yield Finding(f"{n} steps: largest change of spin, rad/s", 0.0, gained, 0.0, absolute=True)


def with_large(simulation: Simulation, i: int) -> HertzImpact:
    """Return the closed form of a small sphere and the large one listed before it."""
    return between(simulation, i - 1, i)


def judge_on_large(bench: Bench) -> Findings:
    """Compare the spheres that spin on large ones with those on the plane, in the same numbers."""
    row = Row(bench, ON_LARGE, impact=with_large)
    exact, angle = answer(Row(bench, ON_PLANE)), angles(row)
    yield from compare("", row, exact, MEASURES, WITH_DAMPING, [f"{each:.0f}°" for each in angle])
    yield curve("test 8: on a large sphere", "angle of impact, °", angle, row, exact, MEASURES[0])


ALL = (needs.hertzian, needs.sticks, needs.full_restitution, needs.coulomb_on_elastic_force)
SLIDING = "β = −1 + 3.5 μ (1 + e) vn/vt, recoil tan = (tan θ − 3.5 μ (1 + e))/e where it slides all through"
TEXT = """Chung and Ooi (2011), tests 6 to 8, with e = 0.5. A sphere that spins without moving sideways has a contact
point that slips; up to 64.5° it sticks at times, above it slides all through. Where it sticks the answer is that of a
run with fine steps, as for oblique impacts. Two equal spheres with opposite spins roll on each other like gears, and
nothing tangential may happen, to the last bit. The large sphere of test 8 is so heavy and stiff that it should act as
the plane does; that puts contacts between particles and contacts with walls beside each other. Errors are shares of
1, those of the tangent shares of what it would be without friction."""

FAMILY = Family(
    "spinning_impacts",
    "Impacts of spinning spheres",
    TEXT,
    (
        Case("chung_ooi_6", "a spinning sphere on a plane", "chung_ooi_6_7_8_spin", judge_on_plane, SLIDING, ALL),
        Case(
            "chung_ooi_7",
            "two equal spheres with opposite spins",
            "chung_ooi_6_7_8_spin",
            judge_gears,
            "v'/v = e, no tangential velocity, spins unchanged",
            ALL,
        ),
        Case(
            "chung_ooi_8",
            "a spinning sphere on a large one",
            "chung_ooi_6_7_8_spin",
            judge_on_large,
            f"as test 6: {SLIDING}",
            ALL,
        ),
    ),
)
