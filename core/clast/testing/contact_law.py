"""What holds for every contact law: forces between bodies alone, stiff as told, and friction that only takes."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from clast.maths.rotation import Quat
from clast.maths.vec3 import Vec, add, dot, norm, scale, sub
from clast.parts.contact_law import ContactLaw, ContactLoad, Touch
from clast.testing.bits import same_bits
from clast.testing.claim import Claim, claim, must
from clast.testing.contacts import (
    DT,
    NOTHING,
    RADIUS,
    Contact,
    contact,
    mirrored,
    overlaps,
    repulsion,
    resting,
    touches,
    turned,
)
from clast.testing.draws import directions, negated, numbers, rotate, rotations

STEPS = 200


def claims(law: ContactLaw, params: Any) -> list[Claim]:
    """Return what a contact law with parameters must keep to."""
    whole, bare = contact(law, params), contact(law, params, NOTHING)
    return [
        claim("every answer is a number", lambda touch: _sound(whole, touch), touches()),
        claim("swapping the bodies mirrors every answer", lambda touch: _mirrored(whole, touch), touches()),
        claim(
            "turning the world turns every answer", lambda touch, q: _turned(whole, touch, q), touches(), rotations()
        ),
        claim(
            "without friction and damping, the force is along the normal and free of moments",
            lambda touch: _bare(bare, touch),
            touches(),
        ),
        claim(
            "at rest, the force is the derivative of the energy at what is remembered",
            lambda overlap: _gradient(bare, overlap),
            overlaps(),
        ),
        claim("no contact is stiffer than the stiffness told", lambda d: _no_stiffer(bare, d), overlaps()),
        claim("pressing together and letting go gives no energy", lambda d: _no_engine(bare, d), overlaps()),
        claim("dashpots take power, and never give it", lambda touch: _dashpots_take(whole, touch), touches()),
        claim(
            "sliding to and fro takes work",
            lambda overlap, way, far: _slider_takes(whole, overlap, way, far),
            overlaps(),
            directions(),
            numbers(0.01, 1.0),
        ),
        claim("compiled code gives the same bits as plain Python", lambda: compiled_alike(whole)),
        *(_beyond_touch(bare, whole) if law.reach is not None else ()),
    ]


def _beyond_touch(bare: Contact, whole: Contact) -> list[Claim]:
    """Return what a law must keep to whose contacts hold beyond touch."""
    shares, radii = numbers(0.001, 0.999), numbers(1e-5, 1e-3)
    return [
        claim(
            "beyond touch, the force is the derivative of the energy, and softer than the stiffness told",
            lambda share: _held(bare, share),
            shares,
        ),
        claim(
            "larger bodies hold no less far", lambda r, s: _reaches_further(whole, min(r, s), max(r, s)), radii, radii
        ),
        claim("beyond touch, compiled code gives the same bits as plain Python", lambda: compiled_beyond(whole)),
    ]


def _reach(law: Contact, radius: float) -> float:
    assert law.law.reach is not None
    return float(law.law.reach(law.constants, radius))


def _held(law: Contact, share: float) -> None:
    reach = _reach(law, 0.5 * RADIUS)
    at, h = -share * reach, 1e-4 * min(share, 1.0 - share) * reach
    ends = [resting(at + side * h) for side in (1.0, -1.0)]
    up, down = (law.energy(each, law.fresh) for each in ends)
    force = repulsion(law.answer(resting(at), law.fresh)[0], resting(at))
    told = (up - down) / (2.0 * h)
    must(
        abs(told - force) <= 1e-5 * abs(force),
        lambda: f"{-at:g} m beyond touch: the derivative is {told:g} N, the force {force:g} N",
    )
    high, low = (repulsion(law.answer(each, law.fresh)[0], each) for each in ends)
    slope, stiffness = (high - low) / (2.0 * h), float(law.law.stiffness(law.constants, 0.5 * RADIUS, at))
    must(
        slope <= stiffness * (1.0 + 1e-3),
        lambda: f"{-at:g} m beyond touch: the slope is {slope:g} N/m, 'stiffness' tells {stiffness:g}",
    )


def _reaches_further(law: Contact, small: float, large: float) -> None:
    near, far = _reach(law, small), _reach(law, large)
    must(
        0.0 <= near <= far * (1.0 + 1e-12),
        lambda: f"'reach' is {near:g} m for a radius of {small:g} m, {far:g} m for {large:g} m",
    )


def _numbers(load: ContactLoad) -> list[float]:
    return [*load.force, *load.torque_i, *load.torque_j]


def _size(law: Contact, touch: Touch) -> float:
    """Return the force that the stiffness told makes of the overlap and of what moved, in N."""
    told = abs(float(law.law.stiffness(law.constants, touch.radius, touch.overlap)))
    return told * (touch.overlap + norm(touch.moved)) + max(abs(x) for x in law.answer(touch, law.fresh)[0].force)


def _sound(law: Contact, touch: Touch) -> None:
    load, after = law.answer(touch, law.fresh)
    must(all(math.isfinite(x) for x in _numbers(load)), lambda: f"'load' is {load} at {touch}")
    stored = law.energy(touch, after)
    must(math.isfinite(stored), lambda: f"'energy' is {stored} at {touch}")


def _mirrored(law: Contact, touch: Touch) -> None:
    here, _ = law.answer(touch, law.fresh)
    there, _ = law.answer(mirrored(touch), law.fresh)
    expected = ContactLoad(negated(there.force), there.torque_j, there.torque_i)
    _alike(here, expected, _size(law, touch), touch)


def _turned(law: Contact, touch: Touch, q: Quat) -> None:
    here, _ = law.answer(touch, law.fresh)
    there, _ = law.answer(turned(touch, q), law.fresh)
    turned_here = ContactLoad(rotate(q, here.force), rotate(q, here.torque_i), rotate(q, here.torque_j))
    _alike(turned_here, there, _size(law, touch), touch)


def _alike(found: ContactLoad, expected: ContactLoad, size: float, touch: Touch) -> None:
    arms = (1.0, touch.radius_i, touch.radius_i)
    pairs = [
        (found.force, expected.force),
        (found.torque_i, expected.torque_i),
        (found.torque_j, expected.torque_j),
    ]
    gaps = [norm(sub(a, b)) / arm for (a, b), arm in zip(pairs, arms, strict=True)]
    must(max(gaps) <= 1e-8 * size, lambda: f"{found}, but {expected} at {touch}")


def _bare(law: Contact, touch: Touch) -> None:
    load, _ = law.answer(touch, law.fresh)
    tangential = sub(load.force, scale(dot(load.force, touch.normal), touch.normal))
    size = _size(law, touch)
    loads = (norm(tangential), norm(load.torque_i) / touch.radius_i, norm(load.torque_j) / touch.radius_i)
    must(max(loads) <= 1e-9 * size, lambda: f"'load' is {load} at {touch}")


def _pressed(law: Contact, overlap: float) -> Any:
    """Return what a contact remembers that was pressed to an overlap."""
    history = law.fresh
    for k in range(1, STEPS + 1):
        history = law.answer(resting(overlap * k / STEPS), history)[1]
    return history


def _gradient(law: Contact, overlap: float) -> None:
    history, at, h = _pressed(law, overlap), 0.98 * overlap, 1e-4 * overlap
    up, down = (law.energy(resting(at + side * h), history) for side in (1.0, -1.0))
    force = repulsion(law.answer(resting(at), history)[0], resting(at))
    told = (up - down) / (2.0 * h)
    size = max(abs(force), abs(repulsion(law.answer(resting(overlap), history)[0], resting(overlap))))
    must(
        abs(told - force) <= 1e-5 * size,
        lambda: f"overlap {at:g} m: the derivative is {told:g} N, the force {force:g} N",
    )


def _no_stiffer(law: Contact, overlap: float) -> None:
    h = 1e-4 * overlap
    for name, history, at in (
        ("loading", _pressed(law, overlap - h), overlap),
        ("unloading", _pressed(law, overlap), overlap - 2.0 * h),
    ):
        up, down = (repulsion(law.answer(resting(at + side * h), history)[0], resting(at)) for side in (1.0, -1.0))
        slope, told = (up - down) / (2.0 * h), float(law.law.stiffness(law.constants, 0.5 * RADIUS, at + h))
        must(
            slope <= told * (1.0 + 1e-3), f"{name} at {at:g} m: the slope is {slope:g} N/m, 'stiffness' tells {told:g}"
        )


def _no_engine(law: Contact, overlap: float) -> None:
    path = [overlap * k / STEPS for k in (*range(1, STEPS + 1), *range(STEPS - 1, 0, -1))]
    history, before, given, largest = law.fresh, None, 0.0, 0.0
    for a in path:
        load, history = law.answer(resting(a), history)
        force = repulsion(load, resting(a))
        given += 0.0 if before is None else 0.5 * (force + before[1]) * (a - before[0])
        before, largest = (a, force), max(largest, abs(force * a))
    must(given >= -1e-6 * largest, lambda: f"{-given:g} J come out of pressing to {overlap:g} m")


def _dashpots_take(law: Contact, touch: Touch) -> None:
    still = touch._replace(
        velocity=(0.0, 0.0, 0.0), moved=(0.0, 0.0, 0.0), spin_i=(0.0, 0.0, 0.0), spin_j=(0.0, 0.0, 0.0)
    )
    moving = still._replace(velocity=touch.velocity)
    drag = sub(law.answer(moving, law.fresh)[0].force, law.answer(still, law.fresh)[0].force)
    power = dot(drag, touch.velocity)
    size = norm(drag) * norm(touch.velocity)
    must(power <= 1e-9 * size, lambda: f"dashpots give {power:g} W at {moving}")


def _slider_takes(law: Contact, overlap: float, way: Vec, far: float) -> None:
    """Slide to one side, to the other, and back."""
    n = resting(overlap).normal
    across = sub(way, scale(dot(way, n), n))
    if norm(across) < 0.1:
        return
    stride = scale(far * overlap / STEPS / norm(across), across)
    history, taken, before, size = law.fresh, 0.0, (0.0, 0.0, 0.0), 0.0
    for k in range(4 * STEPS):
        moved = stride if k < STEPS or k >= 3 * STEPS else scale(-1.0, stride)
        touch = resting(overlap)._replace(moved=moved)  # so slowly that dashpots do nothing
        load, history = law.answer(touch, history)
        taken -= 0.5 * dot(add(load.force, before), moved)
        before, size = load.force, max(size, norm(load.force) * norm(stride))
    must(
        taken >= -1e-3 * size * STEPS,
        lambda: f"{-taken:g} J come out of sliding by {far:g} of an overlap of {overlap:g} m",
    )


def compiled_alike(law: Contact, rows: int = 500) -> None:
    """Compare load and energy along random touches, compiled and in plain Python."""
    same_bits(_sweep(law), [law.law.load, law.law.energy], (rows, 10), random_touches(rows), law.constants)


def compiled_beyond(law: Contact, rows: int = 500) -> None:
    """Compare load and energy along random contacts that hold beyond touch, compiled and in plain Python."""
    found = random_touches(rows)
    found[:, 0] = [-share * _reach(law, r) for share, r in zip(np.linspace(0.0, 1.0, rows), found[:, 13], strict=True)]
    same_bits(_sweep(law), [law.law.load, law.law.energy], (rows, 10), found, law.constants)


def _sweep(law: Contact) -> Callable[..., None]:
    """Return a loop over contacts; the choices are constants of it, as in the step loop."""
    load, energy, first, choices = law.law.load, law.law.energy, law.fresh, law.choices

    def sweep(numbers: Any, constants: Any, out: Any) -> None:
        history = first
        for k in range(len(numbers)):
            r = numbers[k]
            touch = Touch(
                r[0], (r[1], r[2], r[3]), (r[4], r[5], r[6]), (r[7], r[8], r[9]), (r[10], r[11], r[12]),
                r[13], r[14], r[15], r[16], r[17], (r[18], r[19], r[20]),
            )  # fmt: skip
            told, history = load(touch, constants, history, DT, choices)
            out[k, 0], out[k, 1], out[k, 2] = told.force
            out[k, 3], out[k, 4], out[k, 5] = told.torque_i
            out[k, 6], out[k, 7], out[k, 8] = told.torque_j
            out[k, 9] = energy(touch, constants, history, choices)

    return sweep


def random_touches(rows: int) -> Any:
    """Return the numbers of random contacts, (rows, 21); the first ones neither slide nor spin."""
    draw = np.random.default_rng(11)
    found = np.empty((rows, 21))
    n = draw.normal(size=(rows, 3))
    found[:, 0] = RADIUS * 10.0 ** draw.uniform(-5.0, -1.3, rows)
    found[:, 1:4] = n / np.linalg.norm(n, axis=1)[:, None]
    found[:, 4:7] = draw.normal(size=(rows, 3))
    found[:, 7:13] = 100.0 * draw.normal(size=(rows, 6))
    found[:, 13:16] = draw.uniform(0.1 * RADIUS, 10.0 * RADIUS, (rows, 3))
    found[:, 16] = 10.0 ** draw.uniform(6.0, 10.0, rows)
    found[:, 17] = 10.0 ** draw.uniform(12.0, 18.0, rows)
    found[:, 18:] = DT * found[:, 4:7]
    found[: rows // 10, 4:13] = found[: rows // 10, 18:] = 0.0
    return found
