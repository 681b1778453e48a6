"""What holds for every damping of motion: it takes energy, adds none, and leaves the stable step that it tells."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from clast.maths.vec3 import Vec, dot
from clast.parts.damping import Damping
from clast.testing.bits import same_bits
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import vectors

STEPS, FAR = 400, 1e3


def claims(damping: Damping, params: Any) -> list[Claim]:
    """Return what a damping with parameters must keep to."""
    known = damping.numbers(params)
    return [
        claim(
            "it brakes and never drives: what it adds to the acceleration is not along the velocity",
            lambda a, v: _brakes(damping, known, a, v),
            vectors(100.0),
            vectors(10.0),
        ),
        claim("what rests without force is left alone", lambda: _quiet(damping, known)),
        claim("an oscillator is stable with the share of the step that it tells", lambda: _stable(damping, params)),
        claim("compiled code gives the same bits as plain Python", lambda: _compiled_alike(damping, known)),
    ]


def _brakes(damping: Damping, known: Any, a: Vec, v: Vec) -> None:
    told = damping.braking(known, a, v)
    good = len(told) == 3 and all(math.isfinite(x) for x in told) and dot(told, v) <= 0.0
    must(good, lambda: f"it adds {told} m/s² at the acceleration {a} m/s² and the velocity {v} m/s")


def _quiet(damping: Damping, known: Any) -> None:
    still = (0.0, 0.0, 0.0)
    told = damping.braking(known, still, still)
    must(not any(told), f"it adds {told} m/s² to what rests")


def _stable(damping: Damping, params: Any) -> None:
    """Swing x'' = −x with leapfrog at almost the step that is left; the unit of time is that of the oscillator."""
    known, share = damping.numbers(params), damping.step_share(params)
    must(0.0 < share <= 1.0, f"'step_share' is {share!r}; it must lie above 0 and not beyond 1")
    h = 0.98 * 2.0 * share
    for x, v in ((1.0, 0.0), (0.3, -0.8), (-0.1, 1.0)):
        for _ in range(STEPS):
            a = -x
            v += h * (a + damping.braking(known, (a, 0.0, 0.0), (v, 0.0, 0.0))[0])
            x += h * v
        must(abs(x) < FAR, f"with a step of {h:g}/ω, {share:g} of the undamped limit, it grows to {x:.3g}")


def _compiled_alike(damping: Damping, known: Any) -> None:
    braking = damping.braking

    def sweep(rows: Any, known: Any, out: Any) -> None:
        for k in range(len(rows)):
            r = rows[k]
            out[k, 0], out[k, 1], out[k, 2] = braking(known, (r[0], r[1], r[2]), (r[3], r[4], r[5]))

    same_bits(sweep, [braking], (300, 3), np.random.default_rng(15).normal(size=(300, 6)), known)
