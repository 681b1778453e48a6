"""What holds for every bond kinematics: rigid motion strains nothing, and the ends get what balances."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from clast.engine.records import build, columns, width
from clast.maths.rotation import IDENTITY, Quat
from clast.maths.vec3 import ZERO, Vec, add, cross, norm, scale, sub
from clast.parts.bond_kinematics import BondKinematics, BondMotion
from clast.parts.bond_model import BondLoad, Strain
from clast.testing.bits import same_bits
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import directions, numbers, rotate, rotation, vectors

LENGTH = 1.3
STEPS, ROWS = 400, 300
LARGEST = 1.2
"""Angle in rad by which the ends turn against each other at most."""


def claims(kinematics: BondKinematics, params: Any) -> list[Claim]:
    """Return what a bond kinematics must keep to."""
    angle = numbers(-LARGEST, LARGEST)
    return [
        claim(
            "turning and moving a bond as one rigid piece strains nothing",
            lambda n, axis, turn: _rigid(kinematics, n, axis, turn),
            directions(),
            directions(),
            numbers(-3.0, 3.0),
        ),
        claim(
            "pulling strains the axis alone", lambda n, e: _pulled(kinematics, n, e), directions(), numbers(-0.3, 0.3)
        ),
        claim(
            "a small twist is told as its angle",
            lambda n, a: _twisted(kinematics, n, a),
            directions(),
            numbers(-0.1, 0.1),
        ),
        claim(
            "forces and moments on the ends balance",
            lambda n, shift, axis, turn, loads: _balanced(kinematics, n, shift, axis, turn, loads),
            directions(),
            vectors(0.3),
            directions(),
            angle,
            vectors(1.0),
        ),
        claim("compiled code gives the same bits as plain Python", lambda: _compiled_alike(kinematics)),
    ]


def follow(kinematics: BondKinematics, n: Vec, d: Vec, w_i: Vec, w_j: Vec) -> tuple[Strain, Any]:
    """Return strains and frame of a bond along n once its ends have turned with steady rates for a unit of time.

    Parameters
    ----------
    d : vector
        Between the centres at the end.
    w_i, w_j : vector
        Angular velocities of the ends.
    """
    start, L0 = np.array([scale(LENGTH, n)]), np.array([LENGTH])
    reference = _first(kinematics.Reference, kinematics.reference(start, L0))
    state = _first(kinematics.State, kinematics.start(start, L0)) if kinematics.start else _zeros(kinematics.State)
    dt, before = 1.0 / STEPS, scale(LENGTH, n)
    strain, frame = None, None
    for k in range(1, STEPS + 1):
        share = k / STEPS
        here = _on_the_way(scale(LENGTH, n), d, w_i, share)
        turned_i, turned_j = (_turned(w, share) for w in (w_i, w_j))
        motion = BondMotion(here, turned_i, turned_j, scale(1.0 / dt, sub(here, before)), w_i, w_j)
        strain, frame, state = kinematics.measure(motion, reference, state, dt)
        before = here
    assert strain is not None
    return strain, frame


def _turned(w: Vec, share: float) -> Quat:
    rate = norm(w)
    return rotation(scale(1.0 / rate, w), rate * share) if rate > 0.0 else IDENTITY


def _on_the_way(start: Vec, end: Vec, w: Vec, share: float) -> Vec:
    """Return the centre vector on the way: it turns with end i, and changes steadily in its frame."""
    inside = rotate(_inverse(_turned(w, 1.0)), end)
    return rotate(_turned(w, share), add(scale(1.0 - share, start), scale(share, inside)))


def _inverse(q: Quat) -> Quat:
    return (q[0], -q[1], -q[2], -q[3])


def _first(record: type | None, values: Any) -> Any:
    return None if record is None else build(record, (float(x) for x in columns(values, 1)[0]))


def _zeros(record: type | None) -> Any:
    return None if record is None else build(record, [0.0] * width(record))


def _rigid(kinematics: BondKinematics, n: Vec, axis: Vec, turn: float) -> None:
    w = scale(turn, axis)
    q = _turned(w, 1.0)
    strain, _ = follow(kinematics, n, rotate(q, scale(LENGTH, n)), w, w)
    sizes = (abs(strain.axial), norm(strain.shear), abs(strain.twist), norm(strain.bending))
    must(max(sizes) < 1e-4, lambda: f"a turn by {turn:g} rad about {axis} of a bond along {n} gives {strain}")


def _pulled(kinematics: BondKinematics, n: Vec, e: float) -> None:
    strain, _ = follow(kinematics, n, scale(LENGTH * (1.0 + e), n), ZERO, ZERO)
    others = (norm(strain.shear), abs(strain.twist), norm(strain.bending))
    good = abs(strain.axial - e * LENGTH) < 1e-9 and max(others) < 1e-9
    must(good, lambda: f"an elongation by {e * LENGTH:g} m along {n} gives {strain}")


def _twisted(kinematics: BondKinematics, n: Vec, angle: float) -> None:
    w = scale(angle, n)
    strain, _ = follow(kinematics, n, scale(LENGTH, n), ZERO, w)
    others = (abs(strain.axial), norm(strain.shear), norm(strain.bending))
    good = abs(strain.twist - angle) < 1e-2 * abs(angle) + 1e-9 and max(others) < 1e-4
    must(good, lambda: f"a twist by {angle:g} rad about {n} gives {strain}")


def _balanced(kinematics: BondKinematics, n: Vec, shift: Vec, axis: Vec, turn: float, loads: Vec) -> None:
    d, w = add(scale(LENGTH, n), shift), scale(turn, axis)
    strain, frame = follow(kinematics, n, d, ZERO, w)
    load = BondLoad(loads[0], scale(loads[1], strain.shear), loads[2], scale(loads[1], strain.bending))
    ends = kinematics.end_loads(load, frame)
    left = add(add(ends.moment_i, ends.moment_j), cross(d, ends.force))
    size = norm(ends.moment_i) + norm(ends.moment_j) + norm(ends.force) * norm(d)
    must(norm(left) <= 1e-9 * size + 1e-12, lambda: f"{ends} at d = {d} turn the bond with {left}")


def _compiled_alike(kinematics: BondKinematics) -> None:
    """Compare strains and loads of the ends along a random way, compiled and in plain Python."""
    start, L0 = np.array([[LENGTH, 0.0, 0.0]]), np.array([LENGTH])
    reference = _first(kinematics.Reference, kinematics.reference(start, L0))
    state = _first(kinematics.State, kinematics.start(start, L0)) if kinematics.start else _zeros(kinematics.State)
    draw = np.random.default_rng(9)
    ways = np.cumsum(0.01 * draw.normal(size=(ROWS, 9)), axis=0)
    turns = np.array([[*_turned(tuple(w[3:6]), 1.0), *_turned(tuple(w[6:9]), 1.0)] for w in ways])
    sweep, functions = _sweep(kinematics, state)
    same_bits(sweep, functions, (ROWS, 17), ways, turns, reference)


def _sweep(kinematics: BondKinematics, first: Any) -> tuple[Callable[..., None], list[Callable[..., Any]]]:
    """Return a loop that takes a bond along a way, and the functions that it calls."""
    measure, end_loads = kinematics.measure, kinematics.end_loads

    def sweep(ways: Any, turns: Any, reference: Any, out: Any) -> None:
        state = first
        for k in range(len(ways)):
            a, q = ways[k], turns[k]
            motion = BondMotion(
                (LENGTH + a[0], a[1], a[2]), (q[0], q[1], q[2], q[3]), (q[4], q[5], q[6], q[7]),
                (a[0], a[1], a[2]), (a[3], a[4], a[5]), (a[6], a[7], a[8]),
            )  # fmt: skip
            strain, frame, state = measure(motion, reference, state, 0.01)
            out[k, 0], out[k, 4] = strain.axial, strain.twist
            out[k, 1], out[k, 2], out[k, 3] = strain.shear
            out[k, 5], out[k, 6], out[k, 7] = strain.bending
            ends = end_loads(BondLoad(strain.axial, strain.shear, strain.twist, strain.bending), frame)
            out[k, 8], out[k, 9], out[k, 10] = ends.force
            out[k, 11], out[k, 12], out[k, 13] = ends.moment_i
            out[k, 14], out[k, 15], out[k, 16] = ends.moment_j

    return sweep, [measure, end_loads]
