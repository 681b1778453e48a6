"""What holds for every bond model: an energy whose derivatives are the loads, and nothing for free."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
from hypothesis import strategies as st

from clast.engine.records import numbers
from clast.maths.vec3 import Vec
from clast.parts.bond_model import BondLoad, BondModel, Dashpots, RandomKey, Strain
from clast.scene.rehearsal import Rehearsal
from clast.testing.bond_bits import compiled_alike
from clast.testing.bonds import (
    GEOMETRY,
    KEY,
    L0,
    NOTHING,
    SIZES,
    Answer,
    Bond,
    bond,
    flat,
    follow,
    from_flat,
    paths,
    pulled,
    ramp,
    scaled,
    strains,
    stretched,
    turned_about_axis,
)
from clast.testing.claim import Claim, claim, must
from clast.testing.draws import negated
from clast.testing.draws import numbers as floats

TURNS = 400


def claims(model: BondModel, params: Any) -> list[Claim]:
    """Return what a bond model with parameters must keep to."""
    law = bond(model, params)
    far = 2.0 * law.size
    drawn = paths(far)
    return [
        claim("every function gives what it is asked for", lambda: _answers(law)).needed(),
        claim("an undeformed bond carries nothing, stores nothing and is far from breaking", lambda: _rests(law)),
        claim("energy is never negative, and every answer is a number", lambda path: _sound(law, path), drawn),
        claim("loads are the derivatives of the energy at a fixed state", lambda path: _gradient(law, path), drawn),
        claim("the stiffness told is the slope of the loads at the start", lambda: _slope(law)),
        claim("no loading is stiffer than the stiffness told", lambda path: _no_stiffer(law, path), drawn),
        claim("swapping the ends mirrors every answer", lambda path: _mirrored(law, path), drawn),
        claim(
            "turning the bond about its axis turns every answer",
            lambda path, angle: _turned(law, path, angle),
            drawn,
            floats(0.0, 6.0),
        ),
        claim("the failure index grows from 0 to 1 without a jump", lambda end: _no_jump(law, end), strains(far)),
        claim("a bond that is pulled breaks, or its failure index stays 0", lambda: _breaks(law)),
        claim("a broken bond has one of the modes told", lambda end: _mode(law, end), strains(3.0 * far)),
        claim("no closed path gives energy", lambda path: _no_engine(law, path), paths(0.5 * law.size)),
        *_claims_of_options(law, drawn),
        claim("compiled code gives the same bits as plain Python", lambda: compiled_alike(law)),
    ]


def _claims_of_options(law: Bond, drawn: st.SearchStrategy[list[Strain]]) -> list[Claim]:
    found = []
    if law.model.flow is not None:
        says = "asked again at the same strain, the state flows no further"
        found.append(claim(says, lambda path: _settled(law, path), drawn))
    if law.model.on_event is not None:
        found.append(claim("no event adds energy", lambda path: _events_release(law, path), drawn))
    if law.model.dashpots is not None:
        found.append(claim("dashpots take energy and never give it", lambda: _dashpots_resist(law)))
    return found


def _answers(law: Bond) -> None:
    model, c, at = law.model, law.constants, stretched(0.01 * law.size)
    call = Rehearsal().call
    state = law.start if model.flow is None else call(model.flow, model.State, at, c, law.start)
    load = call(model.load, BondLoad, at, c, state)
    call(model.failure, float, at, load, c, state)
    call(model.mode, int, at, load, c, state)
    call(model.energy, float, at, c, state)
    if model.overload is not None and model.on_event is not None:
        call(model.overload, float, at, c, state)
        call(model.on_event, model.State, at, c, state, KEY)


def _breaks(law: Bond) -> None:
    largest = max(told.failure for told in pulled(law))
    must(
        largest == 0.0 or largest >= 1.0,
        f"'failure' comes to {largest:g} and never to 1, though the bond is pulled to twice its length",
    )


def _rests(law: Bond) -> None:
    load = law.model.load(NOTHING, law.constants, law.start)
    must(flat(load) == [0.0] * 8, lambda: f"'load' is {load}")
    stored = law.model.energy(NOTHING, law.constants, law.start)
    must(stored == 0.0, lambda: f"'energy' is {stored:g} J")
    index = law.model.failure(NOTHING, load, law.constants, law.start)
    must(index == 0.0, lambda: f"'failure' is {index:g}")


def _energy(law: Bond, told: Answer) -> float:
    return float(law.model.energy(told.strain, law.constants, told.state))


def _sound(law: Bond, path: list[Strain]) -> None:
    for told in follow(law, path):
        stored = _energy(law, told)
        must(stored >= 0.0, lambda: f"'energy' is {stored:g} J at {told.strain}, state {told.state}")  # noqa: B023
        row = [*flat(told.load), told.failure]
        must(all(math.isfinite(x) for x in row), lambda: f"{told.load}, index {told.failure} at {told.strain}")  # noqa: B023
        must(told.failure >= 0.0, lambda: f"'failure' is {told.failure:g} at {told.strain}")  # noqa: B023


def _slopes(value: Callable[[Strain], Any], at: Strain, step: float) -> list[Any]:
    """Return the central differences of a function of strains in each of the eight measures."""
    row, found = np.array(flat(at)), []
    for k, h in enumerate(step * SIZES):
        up, down = row.copy(), row.copy()
        up[k] += h
        down[k] -= h
        found.append((value(from_flat(up.tolist())) - value(from_flat(down.tolist()))) / (up[k] - down[k]))
    return found


def _gradient(law: Bond, path: list[Strain]) -> None:
    told = follow(law, path)[-1]

    def energy(at: Strain) -> float:
        return float(law.model.energy(at, law.constants, told.state))

    step = 1e-3 * law.size
    # a bond may be stiffer when it is pressed than when it is pulled: slopes are not taken across that
    axial = told.strain.axial if abs(told.strain.axial) > step * L0 else 2.0 * step * L0
    at = told.strain._replace(axial=axial)
    found = np.array(_slopes(energy, at, step)) * SIZES
    wanted = np.array(flat(law.model.load(at, law.constants, told.state))) * SIZES
    size = max(np.abs(wanted).max(), _reference(law) * 1e-6)
    must(
        bool(np.abs(found - wanted).max() <= 2e-3 * size),
        lambda: (
            f"at {at}, state {told.state}: the derivatives are "
            f"{BondLoad(*_as_load(found / SIZES))}, 'load' is {BondLoad(*_as_load(wanted / SIZES))}"
        ),
    )


def _as_load(row: Any) -> tuple[float, Vec, float, Vec]:
    a, b, c, d, e, f, g, h = (float(x) for x in row)
    return a, (b, c, d), e, (f, g, h)


def _told_stiffness(law: Bond) -> Any:
    axial, shear, torsion, bending = (float(k) for k in law.model.stiffness(law.params, GEOMETRY))
    return np.array([axial, shear, shear, shear, torsion, bending, bending, bending])


def _reference(law: Bond) -> float:
    """Return the largest load times strain measure at the size of the first event, in J."""
    return float((_told_stiffness(law) * SIZES**2).max() * law.size)


def _slope(law: Bond) -> None:
    told = _told_stiffness(law)

    def load(at: Strain) -> Any:
        return np.array(flat(law.model.load(at, law.constants, law.start)))

    found = np.diag(np.array(_slopes(load, NOTHING, 1e-6 * law.size)))
    names = ("axial", "shear", "shear", "shear", "torsion", "bending", "bending", "bending")
    for name, a, b in zip(names, found.tolist(), told.tolist(), strict=True):
        must(abs(a - b) <= 1e-6 * abs(b) + 1e-12, f"{name}: the slope is {a:g}, 'stiffness' tells {b:g}")


def _no_stiffer(law: Bond, path: list[Strain]) -> None:
    told = follow(law, path)[-1]

    def load(at: Strain) -> Any:
        return np.array(flat(law.model.load(at, law.constants, told.state))) * SIZES

    slopes = np.array(_slopes(load, told.strain, 1e-4 * law.size)) * SIZES[:, None]
    root = np.sqrt(np.maximum(_told_stiffness(law), 1e-300)) * SIZES
    largest = float(np.linalg.norm(slopes / root / root[:, None], 2))
    must(
        largest <= 1.0 + 1e-6,
        lambda: f"{largest:g} times 'stiffness' at {told.strain}, state {told.state}: the time step is not safe",
    )


def _mirrored(law: Bond, path: list[Strain]) -> None:
    def swapped(a: Any) -> Any:
        return type(a)(a[0], negated(a[1]), a[2], negated(a[3]))

    here, there = follow(law, path), follow(law, [swapped(strain) for strain in path])
    _alike(law, here, there, swapped)


def _turned(law: Bond, path: list[Strain], angle: float) -> None:
    def turn(a: Any) -> Any:
        return type(a)(a[0], turned_about_axis(a[1], angle), a[2], turned_about_axis(a[3], angle))

    here, there = follow(law, path), follow(law, [turn(strain) for strain in path])
    _alike(law, here, there, turn)


def _alike(law: Bond, here: list[Answer], there: list[Answer], change: Callable[[Any], Any]) -> None:
    for a, b in zip(here, there, strict=False):
        if a.failure >= 1.0 - 1e-9:
            return
        difference = np.abs(np.array(flat(change(a.load))) - np.array(flat(b.load))) * SIZES
        close = difference.max() <= 1e-8 * _reference(law) and abs(a.failure - b.failure) <= 1e-8
        must(
            bool(close),
            lambda: (
                f"{a.load}, index {a.failure:g} at {a.strain}, but {b.load}, index {b.failure:g} at {b.strain}"  # noqa: B023
            ),
        )


def _no_jump(law: Bond, end: Strain) -> None:
    told = follow(law, ramp(NOTHING, end, TURNS))
    for a, b in pairwise([Answer(NOTHING, law.start, BondLoad(*NOTHING), 0.0), *told]):
        must(b.failure - a.failure <= 0.2, f"'failure' jumps from {a.failure:g} to {b.failure:g} at {b.strain}")


def _mode(law: Bond, end: Strain) -> None:
    told = follow(law, [scaled(end, share) for share in (0.25, 0.5, 1.0)])[-1]
    mode = law.model.mode(told.strain, told.load, law.constants, told.state)
    must(mode in range(len(law.model.modes)), f"'mode' is {mode!r} at {told.strain}; there are {law.model.modes}")


def _no_engine(law: Bond, corners: list[Strain]) -> None:
    places = [NOTHING, *corners, NOTHING]
    path = [strain for a, b in pairwise(places) for strain in ramp(a, b, TURNS)]
    told = follow(law, path)
    if told[-1].failure >= 1.0:
        return
    given = sum(_work(law, a, b) for a, b in pairwise([Answer(NOTHING, law.start, BondLoad(*NOTHING), 0.0), *told]))
    size = max(_energy(law, each) for each in told)
    left = _energy(law, told[-1])
    must(given - left >= -1e-3 * size - 1e-300, lambda: f"{left - given:g} J come out of nothing along {corners}")


def _work(law: Bond, a: Answer, b: Answer) -> float:
    pairs = zip(flat(a.load), flat(b.load), flat(a.strain), flat(b.strain), strict=True)
    return sum(0.5 * (f + g) * (y - x) for f, g, x, y in pairs)


def _settled(law: Bond, path: list[Strain]) -> None:
    assert law.model.flow is not None
    told = follow(law, path)[-1]
    if law.model.on_event is not None or told.state is None:
        return
    again = law.model.flow(told.strain, law.constants, told.state)
    difference = np.abs(np.array(numbers(again)) - np.array(numbers(told.state)))
    size = np.abs(np.array(numbers(told.state))).max()
    must(bool(difference.max() <= 1e-9 * size), lambda: f"{told.state} becomes {again} at {told.strain}")


def _events_release(law: Bond, path: list[Strain]) -> None:
    model, c, state = law.model, law.constants, law.start
    assert model.on_event is not None
    assert model.overload is not None
    for strain in path:
        for _ in range(100):
            if not model.overload(strain, c, state) > 1.0:
                break
            after = model.on_event(strain, c, state, RandomKey(1, 17))
            gained = model.energy(strain, c, after) - model.energy(strain, c, state)
            must(gained <= 1e-12 * model.energy(strain, c, state), f"an event adds {gained:g} J at {strain}")
            state = after


def _dashpots_resist(law: Bond) -> None:
    assert law.model.dashpots is not None
    told = law.model.dashpots(law.params, GEOMETRY)
    for name, c in zip(Dashpots._fields, told, strict=True):
        must(bool(np.all(np.isfinite(c) & (np.asarray(c) >= 0.0))), lambda: f"{name}: the coefficient is {c}")  # noqa: B023
