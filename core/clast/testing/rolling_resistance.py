"""What holds for every rolling resistance: torques between bodies alone that only take, and say what they take."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from clast.engine.records import build, width
from clast.maths.vec3 import ZERO, add, dot, norm, scale, sub
from clast.parts.contact_law import Touch
from clast.parts.rolling_resistance import Pressing, RollingLoad, RollingResistance
from clast.testing.bits import same_bits
from clast.testing.claim import Claim, claim, must
from clast.testing.contact_law import random_touches
from clast.testing.contacts import DT, GLASS, RADIUS, mirrored, resting, touches
from clast.testing.draws import numbers

PRESSED = Pressing(limit=0.02, stiffness=5e4, stiffness_before=5e4)
STEPS = 1000


class Rolling(NamedTuple):
    """A rolling resistance with the numbers of one pair of materials and its choices."""

    part: RollingResistance
    constants: Any
    choices: Any

    @property
    def fresh(self) -> Any:
        """What a contact remembers when it begins."""
        return None if self.part.History is None else build(self.part.History, [0.0] * width(self.part.History))

    def answer(self, touch: Touch, history: Any, dt: float = DT) -> tuple[RollingLoad, Any]:
        """Return the torques and what is remembered."""
        load, after = self.part.load(touch, self.constants, history, PRESSED, dt, self.choices)
        return load, after


def claims(part: RollingResistance, params: Any) -> list[Claim]:
    """Return what a rolling resistance with parameters must keep to."""
    rolling = Rolling(part, part.constants(params, GLASS), part.choices(params))
    return [
        claim("every answer is a number", lambda touch: _sound(rolling, touch), touches()),
        claim("swapping the bodies mirrors every answer", lambda touch: _mirrored(rolling, touch), touches()),
        claim("nothing acts on what does not roll", lambda touch: _still(rolling, touch), touches()),
        claim("torques act against the spins", lambda touch: _takes(rolling, touch), touches()),
        claim(
            "what rolling to and fro takes is stored or told as lost",
            lambda rate: _accounted(rolling, rate),
            numbers(1.0, 100.0),
        ),
        claim("compiled code gives the same bits as plain Python", lambda: _compiled_alike(rolling)),
    ]


def turning(touch: Touch, dt: float = DT) -> Touch:
    """Return a touch that has turned since the forces before as its spins tell."""
    return touch._replace(turned=scale(dt, sub(touch.spin_j, touch.spin_i)))


def _sound(rolling: Rolling, touch: Touch) -> None:
    load, _ = rolling.answer(turning(touch), rolling.fresh)
    must(all(math.isfinite(x) for x in (*load.torque_i, *load.torque_j)), lambda: f"'load' is {load} at {touch}")


def _mirrored(rolling: Rolling, touch: Touch) -> None:
    here, _ = rolling.answer(turning(touch), rolling.fresh)
    there, _ = rolling.answer(turning(mirrored(touch)), rolling.fresh)
    size = norm(here.torque_i) + norm(here.torque_j)
    gap = max(norm(sub(here.torque_i, there.torque_j)), norm(sub(here.torque_j, there.torque_i)))
    must(gap <= 1e-9 * size, lambda: f"{here}, but {there} at {touch}")


def _still(rolling: Rolling, touch: Touch) -> None:
    load, _ = rolling.answer(touch._replace(spin_i=ZERO, spin_j=ZERO, turned=ZERO), rolling.fresh)
    must(load == RollingLoad(ZERO, ZERO), lambda: f"'load' is {load} at {touch}")


def _takes(rolling: Rolling, touch: Touch) -> None:
    load, _ = rolling.answer(turning(touch), rolling.fresh)
    power = dot(load.torque_i, touch.spin_i) + dot(load.torque_j, touch.spin_j)
    size = norm(load.torque_i) * norm(touch.spin_i) + norm(load.torque_j) * norm(touch.spin_j)
    must(power <= 1e-9 * size, lambda: f"{power:g} W are given at {touch}")


def _accounted(rolling: Rolling, rate: float) -> None:
    """Roll to and fro with a rate in rad/s, and a little more slowly at the turns."""
    dt, history, drag, torque = 1e-6, rolling.fresh, ZERO, ZERO
    work = lost = turnover = 0.0
    for k in range(STEPS):
        spin = (rate * math.sin(2.0 * math.pi * (k + 0.5) / STEPS), 0.0, 0.0)
        touch = turning(resting(0.01 * RADIUS)._replace(spin_i=scale(-0.5, spin), spin_j=scale(0.5, spin)), dt)
        load, after = rolling.answer(touch, history, dt)
        rest = (load, after, PRESSED, dt, rolling.choices, drag)
        told = rolling.part.losses(touch, rolling.constants, history, *rest)
        done = 0.5 * dot(add(load.torque_i, torque), touch.turned)
        work, lost, turnover = work + done, lost + told.rolling + told.stiffening, turnover + abs(done)
        history, drag, torque = after, told.drag, load.torque_i
    energy, stiffness = rolling.part.energy, PRESSED.stiffness
    stored = energy(rolling.constants, history, 0.5 * RADIUS, stiffness) if energy is not None else 0.0
    must(
        abs(work - stored - lost) <= 1e-2 * turnover,
        lambda: f"{work:g} J are taken, {stored:g} J stored, {lost:g} J told as lost at {rate:g} rad/s",
    )


def _compiled_alike(rolling: Rolling, rows: int = 500) -> None:
    same_bits(_sweep(rolling), [rolling.part.load], (rows, 6), random_touches(rows), rolling.constants)


def _sweep(rolling: Rolling) -> Callable[..., None]:
    """Return a loop over contacts; the choices are constants of it, as in the step loop."""
    load, first, choices = rolling.part.load, rolling.fresh, rolling.choices

    def sweep(table: Any, constants: Any, out: Any) -> None:
        history = first
        for k in range(len(table)):
            r = table[k]
            n, w_i, w_j = (r[1], r[2], r[3]), (r[7], r[8], r[9]), (r[10], r[11], r[12])
            turned = (DT * (w_j[0] - w_i[0]), DT * (w_j[1] - w_i[1]), DT * (w_j[2] - w_i[2]))
            still = (0.0, 0.0, 0.0)
            touch = Touch(r[0], n, still, w_i, w_j, r[13], r[14], r[15], r[16], r[17], still, turned)
            told, history = load(touch, constants, history, PRESSED, DT, choices)
            out[k, 0], out[k, 1], out[k, 2] = told.torque_i
            out[k, 3], out[k, 4], out[k, 5] = told.torque_j

    return sweep
