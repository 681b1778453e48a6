"""One bond on its own: what a model answers to strains, in the order in which the step loop asks it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from hypothesis import strategies as st

from clast.engine.records import build, width
from clast.maths.vec3 import Vec, scale
from clast.parts.bond_model import BondGeometry, BondLoad, BondModel, RandomKey, Strain
from clast.testing.claim import must
from clast.testing.draws import numbers, vectors

L0, R = 0.26e-3, 0.125e-3
GEOMETRY = BondGeometry(L0, R, math.pi * R**2, math.pi * R**4 / 4.0)
SIZES = np.array([L0] * 4 + [L0 / R] * 4)
"""By what a strain of 1 moves each of the eight measures, in m and rad."""
KEY = RandomKey(1, 17)
MOST_EVENTS = 10_000


class Bond(NamedTuple):
    """A model with parameters, the numbers of one bond, the state it starts in.

    ``size`` is the axial strain of about its first break, flow or event; 0.01 where there is none.
    """

    model: BondModel
    params: Any
    constants: Any
    start: Any
    size: float = 0.01


class Answer(NamedTuple):
    """What a bond does at one strain."""

    strain: Strain
    state: Any
    load: BondLoad
    failure: float


def bond(model: BondModel, params: Any) -> Bond:
    """Return one bond of a model."""
    start = None if model.State is None else build(model.State, [0.0] * width(model.State))
    made = Bond(model, params, model.constants(params, GEOMETRY), start)
    try:
        return made._replace(size=_first_event(made))
    except Exception:  # the claims will meet it too, and tell it
        return made


def answer(bond: Bond, strain: Strain, state: Any) -> Answer:
    """Return the answer to one strain in the order of the step loop: flow, events unless it fails, load."""
    model, c = bond.model, bond.constants
    state = model.flow(strain, c, state) if model.flow else state
    load = model.load(strain, c, state)
    if model.overload and model.on_event and model.failure(strain, load, c, state) < 1.0:
        events = 0
        while model.overload(strain, c, state) > 1.0:
            state, events = model.on_event(strain, c, state, KEY), events + 1
            must(events < MOST_EVENTS, f"'overload' stays above 1 after {events} events at {strain}")
        load = model.load(strain, c, state)
    return Answer(strain, state, load, model.failure(strain, load, c, state))


def follow(bond: Bond, path: Iterable[Strain]) -> list[Answer]:
    """Return the answers along a path of strains, up to where the bond breaks."""
    state, told = bond.start, []
    for strain in path:
        told.append(answer(bond, strain, state))
        state = told[-1].state
        if told[-1].failure >= 1.0:
            break
    return told


def scaled(strain: Strain, factor: float) -> Strain:
    """Return a multiple of a strain."""
    return Strain(
        factor * strain.axial, scale(factor, strain.shear), factor * strain.twist, scale(factor, strain.bending)
    )


def ramp(begin: Strain, end: Strain, steps: int) -> list[Strain]:
    """Return a straight path from one strain to another, without its begin."""
    a, b = flat(begin), flat(end)
    shares = [k / steps for k in range(1, steps + 1)]
    return [from_flat([(1.0 - s) * x + s * y for x, y in zip(a, b, strict=True)]) for s in shares]


def strains(size: float) -> st.SearchStrategy[Strain]:
    """Draw strains of which each measure alone strains some fibre of the bond by up to ``size``."""
    angle = size * L0 / R
    return st.builds(Strain, numbers(-size * L0, size * L0), vectors(size * L0), numbers(-angle, angle), vectors(angle))


def paths(size: float) -> st.SearchStrategy[list[Strain]]:
    """Draw a few strains, one after the other."""
    return st.lists(strains(size), min_size=1, max_size=5)


def flat(record: Strain | BondLoad) -> list[float]:
    """Return the eight numbers of strains or loads in a row."""
    axial, shear, twist, bending = record
    return [axial, *shear, twist, *bending]


def from_flat(row: Iterable[float]) -> Strain:
    """Return the strains whose eight numbers stand in a row."""
    a, b, c, d, e, f, g, h = row
    return Strain(a, (b, c, d), e, (f, g, h))


NOTHING = Strain(0.0, (0.0, 0.0, 0.0), 0.0, (0.0, 0.0, 0.0))


def stretched(epsilon: float, gamma: float = 0.0) -> Strain:
    """Return an axial and a shear strain."""
    return NOTHING._replace(axial=epsilon * L0, shear=(0.0, gamma * L0, 0.0))


def _first_event(bond: Bond) -> float:
    """Return the axial strain at which a bond that is pulled breaks, flows or has an event; 0.01 if below 1 none."""
    epsilon = 1e-6
    while epsilon < 1.0:
        told = answer(bond, stretched(epsilon), bond.start)
        if told.failure >= 1.0 or told.state != bond.start:
            return epsilon
        epsilon *= 1.1
    return 0.01


def turned_about_axis(a: Vec, angle: float) -> Vec:
    """Return a vector of the bond's frame turned about the bond, its first axis."""
    c, s = math.cos(angle), math.sin(angle)
    return (a[0], c * a[1] - s * a[2], s * a[1] + c * a[2])
