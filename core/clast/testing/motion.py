"""What holds for every motion of a wall: velocities that are numbers, the same for the same question."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from clast.maths.rotation import IDENTITY, turn
from clast.maths.vec3 import ZERO, Vec, add, cross, dot, scale
from clast.parts.motion import Motion, Pressed, Pushed, Turned
from clast.testing.bits import same_bits
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import directions, negated, numbers, rotations, vectors

LONG, SPAN, MASS = 10.0, 1e-6, 1e-6
PUSH, SHORT = 1e-3, 1e-12
PIECES = 400
"""In which velocities are summed up: a jump of the velocity in one of them counts as that much of the way."""


def claims(motion: Motion, params: Any) -> list[Claim]:
    """Return what a motion with parameters must keep to."""
    course = motion.course(params)
    return [
        claim(
            "the velocity is a number at every time, whatever presses",
            lambda time, force, velocity: _sound(motion, course, time, force, velocity),
            numbers(0.0, LONG),
            vectors(100.0),
            vectors(1.0),
        ),
        *_of_ways(motion, course),
        *_of_spins(motion, params, course),
        *_of_pushes(motion, course),
        claim("compiled code gives the same bits as plain Python", lambda: _compiled_alike(motion, course)),
    ]


def _of_ways(motion: Motion, course: Any) -> list[Claim]:
    if motion.way is None:
        return []
    times = [numbers(0.0, LONG)] * 2
    return [
        claim("the way is what the velocities sum up to", lambda a, b: _summed(motion, course, *sorted((a, b))), *times)
    ]


def _of_spins(motion: Motion, params: Any, course: Any) -> list[Claim]:
    if not motion.turns:
        return []
    return [
        claim(
            "the angular velocity is a number at every time, about a pivot that is a place",
            lambda time, moment, spin: _turns(motion, params, course, time, moment, spin),
            numbers(0.0, LONG),
            vectors(100.0),
            vectors(1.0),
        )
    ]


def _of_pushes(motion: Motion, course: Any) -> list[Claim]:
    if motion.inverse_mass is None:
        return []
    return [
        claim(
            "how it gives way is a number, not below 0, whichever way a contact pushes along a line",
            lambda normal, arm, q: _gives_way(motion, course, Pushed(normal, arm, q, MASS)),
            directions(),
            vectors(0.1),
            rotations(),
        ),
        claim(
            "how it gives way is how a push moves it, where that pushes",
            lambda normal, arm, q: _moved(motion, course, Pushed(normal, arm, q, MASS)),
            directions(),
            vectors(0.1),
            rotations(),
        ),
        claim("the share of the stable step that it leaves is above 0, and 1 at most", lambda: _leaves(motion, course)),
    ]


def _gives_way(motion: Motion, course: Any, pushed: Pushed) -> None:
    assert motion.inverse_mass is not None
    told = [motion.inverse_mass(course, pushed._replace(normal=n)) for n in (pushed.normal, negated(pushed.normal))]
    good = all(math.isfinite(each) and each >= 0.0 for each in told) and math.isclose(*told, rel_tol=1e-9)
    must(good, lambda: f"for {pushed} it is {told[0]} /kg, pushed the other way {told[1]} /kg")


def _moved(motion: Motion, course: Any, pushed: Pushed) -> None:
    assert motion.inverse_mass is not None
    assert motion.answer is not None
    gained = 0.0
    for force, sign in ((scale(PUSH, pushed.normal), 1.0), (ZERO, -1.0)):
        velocity = motion.answer(course, 0.0, Pressed(force, pushed.mass, ZERO, SHORT, SHORT))
        if motion.answer_spin is not None:
            turned = Turned(cross(pushed.arm, force), pushed.orientation, ZERO, SHORT, SHORT)
            velocity = add(velocity, cross(motion.answer_spin(course, 0.0, turned), pushed.arm))
        gained += sign * dot(pushed.normal, velocity) / (PUSH * SHORT)
    told = motion.inverse_mass(course, pushed)
    good = math.isclose(told, gained, rel_tol=1e-3)
    must(
        good,
        lambda: f"for {pushed} it is {told:g} /kg, and a short push moves it by {gained:g} m/s per N s",
    )


def _leaves(motion: Motion, course: Any) -> None:
    if motion.step_share is not None:
        shares = [motion.step_share(course, mass, 0.1) for mass in (1e-9, 1e-6, 1e-3, 1.0)]
        must(all(0.0 < each <= 1.0 for each in shares), lambda: f"for particles of 1e-9 to 1 kg it is {shares}")


def spin(motion: Motion, course: Any, time: float, moment: Vec, before: Vec) -> Vec:
    """Return the angular velocity of a wall in rad/s that a moment turns and that has been turning."""
    if motion.spin is not None:
        return motion.spin(course, time)
    assert motion.answer_spin is not None
    return motion.answer_spin(course, time, Turned(moment, IDENTITY, before, SPAN, SPAN))


def _turns(motion: Motion, params: Any, course: Any, time: float, moment: Vec, before: Vec) -> None:
    assert motion.pivot is not None
    told, place = spin(motion, course, time, moment, before), motion.pivot(params)
    good = all(len(each) == 3 and all(map(math.isfinite, each)) for each in (told, place))
    must(good, lambda: f"at {time:g} s it turns with {told} rad/s about {place} m")


def _summed(motion: Motion, course: Any, begin: float, end: float) -> None:
    assert motion.way is not None
    assert motion.velocity is not None
    pieces = np.linspace(begin, end, PIECES + 1)
    speeds = np.array([motion.velocity(course, float(t)) for t in 0.5 * (pieces[1:] + pieces[:-1])])
    told, summed = np.array(motion.way(course, begin, end)), (end - begin) * speeds.mean(axis=0)
    off = float(np.abs(told - summed).max())
    most = 4.0 / PIECES * (end - begin) * float(np.abs(speeds).max()) + 1e-12 * LONG
    must(off <= most, lambda: f"the way from {begin:g} s to {end:g} s is {told} m, the velocities sum up to {summed} m")


def velocity(motion: Motion, course: Any, time: float, force: Vec, velocity: Vec) -> Vec:
    """Return the velocity of a wall in m/s that is pressed and has been moving."""
    if motion.velocity is not None:
        return motion.velocity(course, time)
    assert motion.answer is not None
    return motion.answer(course, time, Pressed(force, MASS, velocity, SPAN, SPAN))


def _sound(motion: Motion, course: Any, time: float, force: Vec, before: Vec) -> None:
    told = velocity(motion, course, time, force, before)
    good = len(told) == 3 and all(math.isfinite(x) for x in told)
    must(good, lambda: f"the velocity is {told} at {time:g} s, pressed by {force} N at {before} m/s")


def _compiled_alike(motion: Motion, course: Any) -> None:
    ahead, answer, way, known_spin, answer_spin, inverse_mass = (
        motion.velocity,
        motion.answer,
        motion.way,
        motion.spin,
        motion.answer_spin,
        motion.inverse_mass,
    )

    def known(times: Any, forces: Any, course: Any, out: Any) -> None:
        for k in range(len(times)):
            out[k, 0], out[k, 1], out[k, 2] = ahead(course, times[k])  # type: ignore[misc]

    def answering(times: Any, forces: Any, course: Any, out: Any) -> None:
        for k in range(len(times)):
            f = forces[k]
            pressed = Pressed((f[0], f[1], f[2]), MASS, (f[3], f[4], f[5]), SPAN, SPAN)
            out[k, 0], out[k, 1], out[k, 2] = answer(course, times[k], pressed)  # type: ignore[misc]

    def going(times: Any, forces: Any, course: Any, out: Any) -> None:
        for k in range(len(times)):
            out[k, 0], out[k, 1], out[k, 2] = way(course, times[k], times[k] + abs(forces[k, 0]))  # type: ignore[misc]

    def turning(times: Any, forces: Any, course: Any, out: Any) -> None:
        for k in range(len(times)):
            out[k, 0], out[k, 1], out[k, 2] = known_spin(course, times[k])  # type: ignore[misc]

    def turned(times: Any, forces: Any, course: Any, out: Any) -> None:
        for k in range(len(times)):
            f = forces[k]
            q = turn(IDENTITY, (f[5], f[0], f[1]), 0.1)
            told = Turned((f[0], f[1], f[2]), q, (f[3], f[4], f[5]), SPAN, SPAN)
            out[k, 0], out[k, 1], out[k, 2] = answer_spin(course, times[k], told)  # type: ignore[misc]

    def pushed(times: Any, forces: Any, course: Any, out: Any) -> None:
        for k in range(len(times)):
            f = forces[k]
            q = turn(IDENTITY, (f[5], f[0], f[1]), 0.1)
            told = Pushed((f[0], f[1], f[2]), (f[3], f[4], f[5]), q, MASS)
            out[k, 0] = inverse_mass(course, told)  # type: ignore[misc]
            out[k, 1] = out[k, 2] = q[0]

    draw = np.random.default_rng(13)
    moves = (known, ahead), (answering, answer), (going, way)
    turns = (turning, known_spin), (turned, answer_spin)
    for sweep, function in (*moves, *turns, (pushed, inverse_mass)):
        if function is not None:
            drawn = draw.uniform(0.0, LONG, 300), draw.normal(size=(300, 6))
            same_bits(sweep, [function, turn], (300, 3), *drawn, course)
