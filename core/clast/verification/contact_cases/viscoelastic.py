"""Impacts of viscoelastic spheres: the coefficient of restitution falls with the speed."""

from __future__ import annotations

import numpy as np

from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Findings
from clast.verification.closed_forms.viscoelastic import restitution
from clast.verification.finding import Finding, worst
from clast.verification.impact_runs import STARTS, motion, on_floor
from clast.verification.sketch import Line, Sketch

ACCURACY = 5e-4
"""Accepted error of v'/v; what the series leaves out at the highest speed is half of it."""


def judge(bench: Bench) -> Findings:
    """Compare the rebound at each speed with the series, the worst of four starts."""
    start = bench.start()
    config = bench.scene().contacts
    assert config is not None
    A = float(getattr(config.law.params, "dissipative_time", 0.0))
    hertz = [on_floor(start, i) for i in range(len(start.scene.radius))]
    expected = [restitution(each.modulus, each.radius, each.mass, A, each.speed) for each in hertz]
    ends = [motion(bench.run({"time.step": start.dt / each})).across for each in STARTS]
    for i, each in enumerate(hertz):
        rebounds = [-float(end[i]) / each.speed for end in ends]
        yield worst(Finding(f"v'/v at {each.speed:g} m/s", expected[i], got, ACCURACY, True) for got in rebounds)
    speeds = np.logspace(-4.0, 0.3, 60)
    first = hertz[0]
    curve = np.array([restitution(first.modulus, first.radius, first.mass, A, float(v)) for v in speeds])
    found = np.array([-end / each.speed for end, each in zip(ends[0], hertz, strict=True)])
    lines = (
        Line("series", speeds, curve),
        Line("Clast", np.array([each.speed for each in hertz]), found, dots=True),
    )
    yield Sketch("viscoelastic: restitution", "speed, m/s", "v'/v", lines)


CASE = Case(
    "viscoelastic_impact",
    "restitution of viscoelastic spheres, which falls with the speed",
    "contact_viscoelastic",
    judge,
    "e = 1 − C₁ x + C₂ x² − 0.483582 x³ + 0.285279 x⁴, x = A κ^(2/5) v^(1/5): Schwager and Pöschel (1998), "
    "doi:10.1103/PhysRevE.57.650",
    (needs.hertzian, needs.law_parameters("dissipative_time"), needs.full_restitution),
)
