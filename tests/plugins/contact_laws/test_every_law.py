"""What holds for every contact law: an energy, mirror images, a stiffness, and a ledger that closes."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings

from clast.engine.records import build, fields, leaves, width
from clast.maths.vec3 import ZERO, add, dot, norm, scale
from clast.parts.contact_law import NO_DRAG, ContactLaw, ContactLoad, Features, Touch
from clast.parts.examples import example
from clast.plugins.discovery import discover
from tests.support.bits import assert_same_bits, random_directions
from tests.support.contacts import DT, GLASS, mirrored, touches, turned
from tests.support.strategies import assert_close, assert_turned, negated, rotations

REGISTRY = discover()
FRICTION = Features(damping=True, sliding=True, rolling=False)
STILL = Features(damping=False, sliding=True, rolling=False)
every_law = pytest.mark.parametrize("name", REGISTRY.names("contact_law"))
RADIUS, MASS, COUNT = 1e-3, 1e-5, 500
UP = (0.0, 0.0, 1.0)


class Law(NamedTuple):
    """A contact law with its examples of parameters, the numbers of one pair of materials, and choices."""

    part: ContactLaw
    constants: Any
    choices: Any

    def fresh(self) -> Any:
        return None if self.part.History is None else build(self.part.History, [0.0] * width(self.part.History))

    def load(self, touch: Touch, history: Any, dt: float = DT) -> tuple[ContactLoad, Any]:
        return self.part.load(touch, self.constants, history, dt, self.choices)

    def energy(self, touch: Touch, history: Any) -> float:
        return self.part.energy(touch, self.constants, history, self.choices)


def law(name: str, features: Features = FRICTION, **written: Any) -> Law:
    part = REGISTRY.get("contact_law", name).part
    params = example(part.Params, written)
    return Law(part, part.constants(params, GLASS), part.choices(params, features))


def sphere(overlap: float, velocity=ZERO, moved=ZERO) -> Touch:
    """Return the contact of two equal spheres."""
    return Touch(
        overlap, UP, velocity, ZERO, ZERO, 0.5 * RADIUS, RADIUS, RADIUS, 2.0 / MASS, 5.0 / (MASS * RADIUS**2), moved
    )


def with_vectors(history: Any, change: Any) -> Any:
    """Return a history with each of its vectors changed."""
    values = [change(v) if f.size == 3 else v for f, v in zip(fields(type(history)), leaves(history), strict=True)]
    return build(type(history), [float(x) for v in values for x in np.ravel(v)])


@every_law
@settings(max_examples=30)
@given(touch=touches())
def test_swapping_the_bodies_mirrors_the_loads_to_the_bit(name, touch):
    bound = law(name)
    _, history = bound.load(touch, bound.fresh())
    told, kept = bound.load(touch, history)
    there, mirror = bound.load(mirrored(touch), with_vectors(history, negated))
    assert there == ContactLoad(negated(told.force), told.torque_j, told.torque_i)
    assert mirror == with_vectors(kept, negated)


@every_law
@settings(max_examples=30)
@given(touch=touches(), q=rotations())
def test_a_rotated_world_gives_rotated_loads(name, touch, q):
    bound = law(name)
    told, _ = bound.load(touch, bound.fresh())
    there, _ = bound.load(turned(touch, q), bound.fresh())
    size = norm(told.force) + norm(bound.load(touch._replace(velocity=ZERO, moved=ZERO), bound.fresh())[0].force)
    assert_turned(there.force, told.force, q, size, 1e-8)


@every_law
@pytest.mark.parametrize("share", [0.999, 0.5, 0.05])
def test_the_force_at_rest_is_the_slope_of_the_energy_on_the_way_back(name, share):
    bound, deepest = law(name, STILL), 0.01 * RADIUS
    _, history = bound.load(sphere(deepest), bound.fresh())
    overlap, h = share * deepest, 1e-4 * share * deepest
    force, _ = bound.load(sphere(overlap), history)
    slope = (bound.energy(sphere(overlap + h), history) - bound.energy(sphere(overlap - h), history)) / (2.0 * h)
    largest = norm(bound.load(sphere(deepest), bound.fresh())[0].force)
    assert dot(force.force, UP) == pytest.approx(slope, rel=1e-6, abs=1e-6 * largest)


@every_law
def test_the_declared_stiffness_is_no_smaller_than_the_slope_of_the_force_on_either_way(name):
    """It limits the time step, so a law that is stiffer on its way back declares that."""
    bound, overlap, h = law(name, STILL), 0.01 * RADIUS, 1e-8 * RADIUS
    told = bound.part.stiffness(bound.constants, 0.5 * RADIUS, overlap)
    for history in (bound.fresh(), bound.load(sphere(overlap), bound.fresh())[1]):
        here, there = (dot(bound.load(sphere(d), history)[0].force, UP) for d in (overlap - h, overlap))
        slope = (there - here) / h
        assert 0.0 < slope <= told * (1.0 + 1e-5)


@every_law
@pytest.mark.parametrize("features", [FRICTION, STILL], ids=["damped", "undamped"])
def test_work_is_stored_or_lost(name, features):
    """Pressed in and half way out while sheared to and fro; what a law books is never computed as the rest."""
    bound, steps, span = law(name, features), 4000, 2e-4
    history, drag, force = bound.fresh(), NO_DRAG, ZERO
    work = lost = turnover = 0.0
    t = np.linspace(0.0, 1.0, steps + 1)
    overlap = 0.01 * RADIUS * np.sin(0.8 * math.pi * t) ** 2
    along = 0.004 * RADIUS * np.sin(6.0 * math.pi * t)
    for k in range(1, steps + 1):
        moved = (along[k] - along[k - 1], 0.0, overlap[k - 1] - overlap[k])
        touch = sphere(overlap[k], scale(steps / span, moved), moved)
        told, kept = bound.load(touch, history, span / steps)
        taken = bound.part.losses(touch, bound.constants, history, told, kept, span / steps, bound.choices, drag)
        done = -0.5 * dot(add(told.force, force), moved)
        work, turnover = work + done, turnover + abs(done)
        lost += sum(taken[:4])
        history, drag, force = kept, taken.drag, told.force
    assert lost > 0.01 * turnover
    assert_close(work, bound.energy(touch, history) + lost, 1e-4, turnover)


@every_law
def test_a_law_gives_the_same_bits_compiled(name):
    bound = law(name, Features(True, True, True))
    rows = random_rows(np.random.default_rng(11), COUNT)
    load, energy = bound.part.load, bound.part.energy
    sweep = sweep_of(load, energy, bound.choices)
    assert_same_bits(sweep, [load, energy], COUNT, 10, rows, bound.constants, bound.fresh())


def sweep_of(load, energy, choices):
    """Return a loop that meets each contact twice; the choices are constants of it, as in the step loop."""

    def sweep(numbers, constants, fresh, out):
        for k in range(len(numbers)):
            r = numbers[k]
            touch = Touch(
                r[0], (r[1], r[2], r[3]), (r[4], r[5], r[6]), (r[7], r[8], r[9]), (r[10], r[11], r[12]),
                r[13], r[14], r[15], r[16], r[17], (r[18], r[19], r[20]),
            )  # fmt: skip
            _, before = load(touch, constants, fresh, 1e-7, choices)
            told, after = load(touch, constants, before, 1e-7, choices)
            out[k, 0], out[k, 1], out[k, 2] = told.force
            out[k, 3], out[k, 4], out[k, 5] = told.torque_i
            out[k, 6], out[k, 7], out[k, 8] = told.torque_j
            out[k, 9] = energy(touch, constants, after, choices)

    return sweep


def random_rows(draw: np.random.Generator, count: int) -> np.ndarray:
    """Return the numbers of random contacts; the first ones neither slide nor spin."""
    rows = np.empty((count, 21))
    rows[:, 0] = 10.0 ** draw.uniform(-9.0, -5.0, count)
    rows[:, 1:4] = random_directions(draw, count)
    rows[:, 4:7] = draw.normal(size=(count, 3))
    rows[:, 7:13] = 100.0 * draw.normal(size=(count, 6))
    rows[:, 13:16] = draw.uniform(1e-5, 1e-3, (count, 3))
    rows[:, 16] = 10.0 ** draw.uniform(6.0, 10.0, count)
    rows[:, 17] = 10.0 ** draw.uniform(12.0, 18.0, count)
    rows[:, 18:] = 1e-7 * rows[:, 4:7]
    rows[:50, 4:13] = rows[:50, 18:] = 0.0
    return rows
