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

    ``size`` is the axial strain at which it breaks when it is pulled; 0.01 where it never does.
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
        return made._replace(size=_breaks_at(made))
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
    """Draw strains, small ones and such of which each measure alone strains some fibre of the bond by ``size``."""
    angle = size * L0 / R
    whole = st.builds(
        Strain, numbers(-size * L0, size * L0), vectors(size * L0), numbers(-angle, angle), vectors(angle)
    )
    return st.builds(scaled, whole, st.sampled_from((1.0, 0.5, 0.2, 0.05, 0.01)))


def paths(size: float) -> st.SearchStrategy[list[Strain]]:
    """Draw a few strains, one after the other, or one along the axis or across it."""
    shares = (0.05, 0.1, 0.2, 0.3, 0.4, 0.45, 0.49, 0.6, 0.8, 1.0)
    straight = [[stretched(s * size)] for s in shares] + [[stretched(0.0, s * size)] for s in shares]
    return st.one_of(st.lists(strains(size), min_size=1, max_size=5), st.sampled_from(straight))


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


def pulled(bond: Bond) -> list[Answer]:
    """Return the answers of a bond that is pulled further and further, until it breaks or is twice as long."""
    told: list[Answer] = []
    state, epsilon = bond.start, 1e-6
    while epsilon < 1.0 and not (told and told[-1].failure >= 1.0):
        told.append(answer(bond, stretched(epsilon), state))
        state = told[-1].state
        epsilon *= 1.02
    return told


def _breaks_at(bond: Bond) -> float:
    """Return the axial strain at which a bond that is pulled breaks; 0.01 where it never does."""
    last = pulled(bond)[-1]
    return last.strain.axial / L0 if last.failure >= 1.0 else 0.01


def turned_about_axis(a: Vec, angle: float) -> Vec:
    """Return a vector of the bond's frame turned about the bond, its first axis."""
    c, s = math.cos(angle), math.sin(angle)
    return (a[0], c * a[1] - s * a[2], s * a[1] + c * a[2])
