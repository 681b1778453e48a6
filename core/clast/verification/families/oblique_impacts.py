"""Oblique impacts on a plane: Chung and Ooi (2011), tests 4 and 5, and impacts that stick all through."""

from __future__ import annotations

import numpy as np

from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Family, Findings
from clast.verification.closed_forms.hertz import effective_modulus
from clast.verification.closed_forms.sticking import effective_tangential_modulus, slip_ratio
from clast.verification.curves import Floats, order
from clast.verification.finding import Finding, worst
from clast.verification.impact_runs import Row, starts
from clast.verification.oblique import (
    COARSE,
    COUNTS,
    FINE,
    REFERENCE,
    WITH_DAMPING,
    WITHOUT_DAMPING,
    Measure,
    answer,
    compare,
    convergence,
    curve,
    impulse,
)
from clast.verification.sketch import Line, Sketch

TEST_4 = (
    Measure("v't/vt", lambda row, after: after.along / row.before.along, lambda row: np.ones_like(row.radius)),
    Measure(
        "spin ω', rad/s", lambda row, after: -after.turning / row.radius, lambda row: 2.5 * impulse(row) / row.radius
    ),
    Measure(
        "rebound angle, °",
        lambda row, after: np.degrees(np.arctan(-after.slip / after.across)),
        lambda row: np.full_like(row.radius, np.degrees(1.0)),
    ),
)
"""Restitution of the tangential speed, spin, and angle at which the contact point rebounds; errors as shares of 1, of
the spin that sliding would give, and of a radian."""

TEST_5 = (
    Measure("V's", lambda row, after: after.slip / unit(row), lambda row: 3.5 * impulse(row) / unit(row)),
    Measure("rω'/(μ vn)", lambda row, after: -after.turning / unit(row), lambda row: 2.5 * impulse(row) / unit(row)),
)
"""Velocities of the contact point and of rolling in units of μ v_n; errors as shares of what sliding takes."""

ROUGH = 1e6
"""A coefficient of friction that nothing slides against."""

STICKING = {COARSE: 1e-2, FINE: 1e-3}
"""Steps per contact, and the error accepted there. At parting the spring is still wound up, and its stiffness ends in a
root of the time, which leaves the order 1.5; where friction is limited, the contact slides before."""


def unit(row: Row) -> Floats:
    """Return μ v_n of each sphere in m/s."""
    return row.friction * row.before.across


def judge_angles(bench: Bench) -> Findings:
    """Compare both rows of test 4 at all angles."""
    half = len(bench.start().scene.radius) // 2
    for e, spheres, accuracy in (("0.98", slice(0, half), WITH_DAMPING), ("1", slice(half, None), WITHOUT_DAMPING)):
        row = Row(bench, spheres)
        angle = np.degrees(np.arctan2(row.before.along, row.before.across))
        exact = answer(row)
        yield from compare(f"e = {e}: ", row, exact, TEST_4, accuracy, [f"{each:.0f}°" for each in angle])
        if e == "0.98":
            for measure in TEST_4:
                yield curve("test 4, e = 0.98", "angle of impact, °", angle, row, exact, measure)
            yield convergence("test 4: error against steps", row, exact)


def judge_speeds(bench: Bench) -> Findings:
    """Compare both rows of test 5, from almost sticking to sliding fast."""
    half = len(bench.start().scene.radius) // 2
    for name, spheres in (("steel", slice(0, half)), ("polymer", slice(half, None))):
        row = Row(bench, spheres)
        speed = row.before.slip / unit(row)
        exact = answer(row)
        yield from compare(f"{name}: ", row, exact, TEST_5, WITHOUT_DAMPING, [f"Vs = {each:.3g}" for each in speed])
        for measure in TEST_5:
            yield curve(f"test 5, {name}", "Vs", speed, row, exact, measure)


def judge_sticking(bench: Bench) -> Findings:
    """Compare what is left of the slip after an impact without sliding with its closed form."""
    lines = []
    for name, first in (("steel", 0), ("polymer", len(bench.start().scene.radius) // 2)):
        row = Row(bench, slice(first, first + 1), {f"contacts.pairs.{name}-rigid.sliding_friction": ROUGH})
        floor, own = (bench.scene().materials[each] for each in ("rigid", name))
        expected = slip_ratio(effective_tangential_modulus(own, floor), effective_modulus(own, floor))
        got = np.array([[float(each.slip[0] / row.before.slip[0]) for each in starts(row, n)] for n in COUNTS])
        for n, bound in STICKING.items():
            values = got[COUNTS.index(n)]
            yield worst(Finding(f"{name}, {n} steps: slip'/slip", expected, each, bound) for each in values)
        error = np.sqrt(np.mean((got / expected - 1.0) ** 2, axis=1))
        lines.append(Line(f"{name}: order {order(COUNTS, error):.1f}", np.array(COUNTS, float), error))
    text = "error of slip'/slip, RMS of four starts"
    yield Sketch("never slides: error against steps", "steps per contact", text, tuple(lines), logarithmic=True)


ALL = (needs.hertzian, needs.sticks, needs.full_restitution, needs.coulomb_on_elastic_force)
SLIDING = "where it slides all through: Coulomb's law, and balances of momentum and moments"
TEXT = f"""Chung and Ooi (2011), tests 4 and 5, and a third case that they do not have. Each number is the worst of
all angles or speeds, and of four impacts that begin at different points of a step.

Above 32° in test 4, and from Vs = 7 on in test 5, the contact point slides all through, and the impulse of friction
is μ (1 + e) m v_n whatever the law. Below, it sticks and slides by turns, and the answer depends on the tangential
law; here that of `hertz_mindlin`: k_t = 8 G* a at the present overlap, without the unloading correction. There is no
closed form for it, so these numbers are compared with a run of the same law with {REFERENCE} steps per contact. That
alone would not notice a wrong stiffness. The third case does: with a friction so large that nothing slides, what
remains of the slip is known in closed form.

Errors are shares of the change that sliding all through would make; those of v't/vt are shares of 1, those of the
angle shares of a radian."""

FAMILY = Family(
    "oblique_impacts",
    "Oblique impacts",
    TEXT,
    (
        Case(
            "chung_ooi_4",
            "one speed, 5 to 85° from the normal",
            "chung_ooi_4_oblique",
            judge_angles,
            f"v't/vt = 1 − μ (1 + e)/tan θ, ω' = −5/2 μ (1 + e) v_n/r {SLIDING}",
            ALL,
        ),
        Case(
            "chung_ooi_5",
            "one normal speed, any tangential speed, elastic",
            "chung_ooi_5_oblique",
            judge_speeds,
            f"V's = Vs − 7, rω'/(μ vn) = −5 {SLIDING}",
            ALL,
        ),
        Case(
            "sticking_impact",
            "friction so large that nothing slides, elastic",
            "chung_ooi_5_oblique",
            judge_sticking,
            "a ratio of gamma functions of G*/E*: own solution of Mindlin's stiffness without slip",
            ALL,
        ),
    ),
)
