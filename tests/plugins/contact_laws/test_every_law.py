"""What holds for every contact law of Clast: the contract of its kind, and a ledger that closes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from clast.config.examples import example
from clast.maths.vec3 import ZERO, add, dot, scale
from clast.parts.contact_law import NO_DRAG, Features, Touch
from clast.plugins.discovery import discover
from clast.testing.bits import same_bits
from clast.testing.contacts import RADIUS, contact, resting
from clast.testing.kit import try_part
from tests.support.strategies import assert_close

REGISTRY = discover()
every_law = pytest.mark.parametrize("name", REGISTRY.names("contact_law"))


@every_law
def test_a_law_keeps_to_the_contract_of_its_kind(name):
    problems = [f"{each.says}: {each.problem}" for each in try_part(REGISTRY.get("contact_law", name)) if each.problem]
    assert problems == []


@every_law
@pytest.mark.parametrize("damping", [True, False], ids=["damped", "undamped"])
def test_work_is_stored_or_lost(name, damping):
    """Pressed in and half way out while sheared to and fro; what a law books is never computed as the rest."""
    part = REGISTRY.get("contact_law", name).part
    law = contact(part, example(part.Params), Features(damping, sliding=True, rolling=False))
    steps, span = 4000, 2e-4
    history, drag, force = law.fresh, NO_DRAG, ZERO
    work = lost = turnover = 0.0
    t = np.linspace(0.0, 1.0, steps + 1)
    overlap = 0.01 * RADIUS * np.sin(0.8 * math.pi * t) ** 2
    along = 0.004 * RADIUS * np.sin(6.0 * math.pi * t)
    for k in range(1, steps + 1):
        touch = moving(overlap[k], (along[k] - along[k - 1], 0.0, overlap[k - 1] - overlap[k]), span / steps)
        told, kept = law.answer(touch, history, span / steps)
        taken = part.losses(touch, law.constants, history, told, kept, span / steps, law.choices, drag)
        done = -0.5 * dot(add(told.force, force), touch.moved)
        work, turnover = work + done, turnover + abs(done)
        lost += sum(taken[:4]) + taken.plastic
        history, drag, force = kept, taken.drag, told.force
    assert lost > 0.01 * turnover
    assert_close(work, law.energy(touch, history) + lost, 1e-4, turnover)


def moving(overlap: float, moved, dt: float) -> Touch:
    """Return the contact of two equal spheres that have moved against each other."""
    return resting(overlap)._replace(velocity=scale(1.0 / dt, moved), moved=moved)


@every_law
def test_what_is_told_as_lost_is_the_same_compiled(name):
    part = REGISTRY.get("contact_law", name).part
    law = contact(part, example(part.Params), Features(damping=True, sliding=True, rolling=False))
    load, losses, choices, yields = part.load, part.losses, law.choices, part.yields

    def sweep(numbers, constants, fresh, drag, out):
        for k in range(len(numbers)):
            overlap, x, z = numbers[k]
            moved, velocity, none = (x, 0.0, z), (1e6 * x, 0.0, 1e6 * z), (0.0, 0.0, 0.0)
            half, m, up = 0.5 * RADIUS, 1e8, (0.0, 0.0, 1.0)
            touch = Touch(overlap, up, velocity, none, none, half, RADIUS, RADIUS, m, m, moved, none)
            _, before = load(touch, constants, fresh, 1e-6, choices)
            told, after = load(touch, constants, before, 1e-6, choices)
            lost = losses(touch, constants, before, told, after, 1e-6, choices, drag)
            out[k, 0], out[k, 1], out[k, 2], out[k, 3] = lost.viscous, lost.sliding, lost.rolling, lost.stiffening
            out[k, 4] = lost.plastic if yields else 0.0

    rows = np.random.default_rng(5).normal(size=(200, 3)) * np.array([0.002, 1e-4, 1e-4]) * RADIUS
    rows[:, 0] = np.abs(rows[:, 0]) + 1e-6 * RADIUS
    same_bits(sweep, [load, losses], (200, 5), rows, law.constants, law.fresh, NO_DRAG)
