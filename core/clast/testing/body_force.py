"""What holds for every body force: a number everywhere, the same force for scaled masses, and a bounded slope."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from clast.maths.vec3 import ZERO, Vec, add, scale
from clast.parts.body_force import BodyForce
from clast.testing.bits import same_bits
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import numbers, vectors

RADIUS = 1e-3
"""Of the particle that loads are tried on, in m."""

SMALL = 1e-3
"""Share of a change of velocity after which loads are asked again."""

SCALED = 100.0
"""Factor on all masses of the scene in which forces are asked again."""

ROUNDING = 1e-9
"""Share by which numbers that should be equal may differ."""

Told = Callable[[Vec, Vec, Vec, float], tuple[Vec, Vec]]


def claims(force: BodyForce, params: Any) -> list[Claim]:
    """Return what a body force with parameters must keep to."""
    known = force.numbers(params, 1.0)
    told = _told(force, known)
    place, motion, time = vectors(1.0), vectors(10.0), numbers(0.0, 10.0)
    scaled = force.numbers(params, SCALED)
    told_scaled = _told(force, scaled)
    found = [
        claim(
            "what it does is a number everywhere, at any velocity, spin and time",
            lambda x, v, w, time: _sound(told, x, v, w, time),
            place,
            motion,
            motion,
            time,
        ),
        claim(
            "scaled masses leave forces what they are: accelerations are divided by mass_scaling, loads are not",
            lambda x, v, w, time: _alike(force, told, told_scaled, x, v, w, time),
            place,
            motion,
            motion,
            time,
        ),
    ]
    if force.damping is not None:
        found.append(
            claim(
                "its damping is at least what its loads change with velocity and spin",
                lambda x, v, d, time: _bounded(force, (known, scaled), told, x, v, d, time),
                place,
                motion,
                motion,
                time,
            )
        )
    return [*found, claim("compiled code gives the same bits as plain Python", lambda: _compiled_alike(force, known))]


def _told(force: BodyForce, known: Any) -> Told:
    acceleration, load = force.acceleration, force.load
    if acceleration is not None:
        return lambda x, v, w, time: (acceleration(known, x, v, time), ZERO)
    assert load is not None
    return lambda x, v, w, time: load(known, x, v, w, RADIUS, time)


def _sound(told: Told, x: Vec, v: Vec, w: Vec, time: float) -> None:
    found = told(x, v, w, time)
    good = len(found) == 2 and all(len(each) == 3 and all(map(math.isfinite, each)) for each in found)
    must(good, lambda: f"it tells {found} at {x} m, {v} m/s, {w} rad/s, {time:g} s")


def _alike(force: BodyForce, told: Told, told_scaled: Told, x: Vec, v: Vec, w: Vec, time: float) -> None:
    factor = SCALED if force.acceleration is not None else 1.0
    what = "acceleration" if force.acceleration is not None else "load"
    plain, scaled = np.array(told(x, v, w, time)), np.array(told_scaled(x, v, w, time))
    wanted = plain / factor
    must(
        np.allclose(scaled, wanted, rtol=ROUNDING, atol=ROUNDING * float(np.abs(wanted).max())),
        lambda: (
            f"with masses times {SCALED:g} its {what} is {scaled.tolist()} at {x} m and {v} m/s; {wanted.tolist()} is "
            "needed: see the second argument of 'numbers'"
        ),
    )


def _bounded(force: BodyForce, known: tuple[Any, Any], told: Told, x: Vec, v: Vec, d: Vec, time: float) -> None:
    assert force.damping is not None
    faster = add(v, scale(SMALL, d))
    before, after = told(x, v, v, time), told(x, faster, faster, time)
    pushed, turned = ((np.array(b) - np.array(a)) / SMALL for a, b in zip(before, after, strict=True))
    size = float(np.linalg.norm(d))
    speeds = np.array([v, faster])
    slopes = [force.damping(each, np.full(2, RADIUS), speeds) for each in known]  # scaled masses leave them alone
    bounds = [min(float(each.max()) for each in of_both) for of_both in zip(*slopes, strict=True)]
    for what, change, bound in (("force", pushed, bounds[0]), ("torque", turned, bounds[1])):
        rate = float(np.linalg.norm(change))
        text = f"the {what} changes by {rate:.4g} for {d} at {v}, its damping tells {bound:.4g} times {size:.4g}"
        must(rate <= bound * size * 1.001 + 1e-9 * bound, text)


def _compiled_alike(force: BodyForce, known: Any) -> None:
    acceleration, load = force.acceleration, force.load

    def pulling(rows: Any, known: Any, out: Any) -> None:
        for k in range(len(rows)):
            r = rows[k]
            out[k, 0], out[k, 1], out[k, 2] = acceleration(known, (r[0], r[1], r[2]), (r[3], r[4], r[5]), r[6])  # type: ignore[misc]

    def loading(rows: Any, known: Any, out: Any) -> None:
        for k in range(len(rows)):
            r = rows[k]
            x, v, w = (r[0], r[1], r[2]), (r[3], r[4], r[5]), (r[7], r[8], r[9])
            force, torque = load(known, x, v, w, r[10], r[6])  # type: ignore[misc]
            out[k, 0], out[k, 1], out[k, 2] = force
            out[k, 3], out[k, 4], out[k, 5] = torque

    rows = np.abs(np.random.default_rng(14).normal(size=(300, 11)))
    if acceleration is not None:
        same_bits(pulling, [acceleration], (300, 3), rows, known)
    if load is not None:
        same_bits(loading, [load], (300, 6), rows, known)
