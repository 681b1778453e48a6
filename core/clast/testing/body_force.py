"""What holds for every body force: an acceleration that is a number everywhere."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from clast.maths.vec3 import Vec
from clast.parts.wall import BodyForce
from clast.testing.bits import same_bits
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import numbers, vectors


def claims(force: BodyForce, params: Any) -> list[Claim]:
    """Return what a body force with parameters must keep to."""
    known = force.numbers(params, 1.0)
    return [
        claim(
            "the acceleration is a number everywhere, at any velocity and time",
            lambda x, v, time: _sound(force, known, x, v, time),
            vectors(1.0),
            vectors(10.0),
            numbers(0.0, 10.0),
        ),
        claim("compiled code gives the same bits as plain Python", lambda: _compiled_alike(force, known)),
    ]


def _sound(force: BodyForce, known: Any, x: Vec, v: Vec, time: float) -> None:
    told = force.acceleration(known, x, v, time)
    good = len(told) == 3 and all(math.isfinite(a) for a in told)
    must(good, lambda: f"the acceleration is {told} at {x} m, {v} m/s, {time:g} s")


def _compiled_alike(force: BodyForce, known: Any) -> None:
    acceleration = force.acceleration

    def sweep(rows: Any, known: Any, out: Any) -> None:
        for k in range(len(rows)):
            r = rows[k]
            told = acceleration(known, (r[0], r[1], r[2]), (r[3], r[4], r[5]), r[6])
            out[k, 0], out[k, 1], out[k, 2] = told

    rows = np.abs(np.random.default_rng(14).normal(size=(300, 7)))
    same_bits(sweep, [acceleration], (300, 3), rows, known)
