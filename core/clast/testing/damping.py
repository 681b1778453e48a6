"""What holds for every damping of motion: it takes energy, adds none, and leaves the stable step that it tells."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from clast.maths.vec3 import Vec, dot
from clast.parts.damping import Damping, Together
from clast.testing.bits import same_bits
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import vectors

STEPS, FAR, ROUNDING = 400, 1e3, 1e-12
DT = 0.3
"""Time step in s where a damping that steers all particles is asked for one."""


def claims(damping: Damping, params: Any) -> list[Claim]:
    """Return what a damping with parameters must keep to."""
    known = damping.numbers(params)
    return [
        claim(
            "it brakes and never drives: what it adds to the acceleration is not along the velocity"
            + ("" if damping.steering is None else ", summed over all particles"),
            lambda a, v, b, w: _brakes(damping, known, (a, b), (v, w)),
            vectors(100.0),
            vectors(10.0),
            vectors(100.0),
            vectors(10.0),
        ),
        claim("what rests without force is left alone", lambda: _quiet(damping, known)),
        claim("an oscillator is stable with the share of the step that it tells", lambda: _stable(damping, params)),
        claim("compiled code gives the same bits as plain Python", lambda: _compiled_alike(damping, known)),
    ]


def added(damping: Damping, known: Any, a: Sequence[Vec], v: Sequence[Vec], dt: float, downhill: int = 0) -> list[Vec]:
    """Return what a damping adds to accelerations in m/s² of particles of 1 kg at their velocities in m/s.

    Parameters
    ----------
    dt : float
        Time step in s.
    downhill : int
        At how many evaluations in a row before this one forces did work on them all; for dampings that steer.
    """
    how = known
    if damping.steering is not None:
        power = math.fsum(map(dot, a, v))
        motion, force = math.fsum(map(dot, v, v)), math.fsum(map(dot, a, a))
        how = damping.steering(known, Together(power, motion, force, downhill + 1 if power > 0.0 else 0, dt))
    return [damping.braking(how, *of_one) for of_one in zip(a, v, strict=True)]


def _brakes(damping: Damping, known: Any, a: Sequence[Vec], v: Sequence[Vec]) -> None:
    for downhill in (0, 40):
        told = added(damping, known, a, v, DT, downhill)
        powers = [dot(*of_one) for of_one in zip(told, v, strict=True)]
        bound = 0.0
        if damping.steering is not None:
            bound, powers = ROUNDING * math.fsum(map(abs, powers)), [math.fsum(powers)]
        good = all(len(one) == 3 and all(map(math.isfinite, one)) for one in told) and max(powers) <= bound
        text = f"it adds {told} m/s² at the accelerations {a} m/s² and the velocities {v} m/s"
        must(good, text)


def _quiet(damping: Damping, known: Any) -> None:
    still = (0.0, 0.0, 0.0)
    (told,) = added(damping, known, [still], [still], DT)
    must(not any(told), f"it adds {told} m/s² to what rests")


def _stable(damping: Damping, params: Any) -> None:
    """Swing x'' = −x with leapfrog at almost the step that is left; the unit of time is that of the oscillator."""
    known, share = damping.numbers(params), damping.step_share(params)
    must(0.0 < share <= 1.0, f"'step_share' is {share!r}; it must lie above 0 and not beyond 1")
    h = 0.98 * 2.0 * share
    for x, v in ((1.0, 0.0), (0.3, -0.8), (-0.1, 1.0)):
        for step in range(STEPS):
            a = -x
            (more,) = added(damping, known, [(a, 0.0, 0.0)], [(v, 0.0, 0.0)], h, step)
            v += h * (a + more[0])
            x += h * v
        must(abs(x) < FAR, f"with a step of {h:g}/ω, {share:g} of the undamped limit, it grows to {x:.3g}")


def _compiled_alike(damping: Damping, known: Any) -> None:
    braking = damping.braking
    steering = damping.steering or (lambda known, together: known)

    def sweep(rows: Any, known: Any, out: Any) -> None:
        for k in range(len(rows)):
            r = rows[k]
            how = steering(known, Together(r[0], abs(r[1]), abs(r[2]), k, DT))
            out[k, 0], out[k, 1], out[k, 2] = braking(how, (r[0], r[1], r[2]), (r[3], r[4], r[5]))

    rows = np.random.default_rng(15).normal(size=(300, 6))
    same_bits(sweep, [braking, steering], (300, 3), rows, known)
