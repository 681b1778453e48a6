"""Spheres on a slope: one that rolling resistance holds, and one that it slows."""

from __future__ import annotations

import numpy as np

from clast.verification import needs
from clast.verification.bench import Bench
from clast.verification.case import Case, Findings
from clast.verification.finding import Finding
from clast.verification.impact_runs import with_floor
from clast.verification.reading import follow, position, spin, velocity
from clast.verification.sketch import Line, Sketch

HELD, ROLLING = 0, 1
"""Particles of the scene."""

LATER, REST, ACCURACY = 0.5, 1e-7, 1e-3
"""Share of the run after which nothing swings any more; accepted speed of what rests in m/s; accepted error."""


def judge(bench: Bench) -> Findings:
    """Compare what is held with rest, and the acceleration of what rolls with its closed form."""
    simulation = bench.start()
    (force,) = simulation.config.body_forces
    along, _, down = (float(each) for each in getattr(force.params, "acceleration"))  # noqa: B009
    mu = with_floor(simulation, ROLLING).rolling_friction
    expected = 5.0 / 7.0 * (along + mu * down)
    places, speeds, spins = follow(simulation, lambda s: (position(s)[:, 0], velocity(s)[:, 0], spin(s)[:, 1]), 100)
    time = 100 * simulation.dt * np.arange(float(len(places)))
    later = time > LATER * time[-1]
    yield Finding("held: speed, m/s", 0.0, float(np.abs(speeds[later, HELD]).max()), REST, True)
    yield Finding("held: spin, rad/s", 0.0, float(np.abs(spins[later, HELD]).max()), REST / 5e-3, True)
    slope = float(np.polyfit(time[later], speeds[later, ROLLING], 1)[0])
    yield Finding("rolling: acceleration, m/s²", expected, slope, ACCURACY)
    rows = slice(0, None, max(1, len(time) // 40))
    lines = (
        Line("closed form", time, 500.0 * expected * time**2),
        Line("μr = 0.06", time[rows], 1e3 * places[rows, ROLLING], dots=True),
        Line("μr = 0.12", time[rows], 1e3 * places[rows, HELD], dots=True),
    )
    yield Sketch("a sphere on a slope of 0.1", "time, s", "way down, mm", lines)


CASE = Case(
    "rolling_slope",
    "rolling resistance on a slope: held below its coefficient, slowed above",
    "contact_rolling",
    judge,
    "rest where μr > tan α, else 5/7 g (sin α − μr cos α): balances of force and moment of a solid sphere",
    (needs.sticks, needs.holds_rolling),
)
