"""Settling rigid grains: under gravity until nothing falls any more, then without it until nothing overlaps.

A grain is as rigid as its primaries' places in it; contacts push in proportion to the overlap and have no friction.
The minimiser is FIRE with the grains' masses and moments of inertia, as of spheres.

Source: E. Bitzek et al., "Structural relaxation made simple", Phys. Rev. Lett. 97 (2006) 170201,
doi:10.1103/PhysRevLett.97.170201.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.errors import PackingError
from clast_plugins.generators.filling.rigid import Grains, Touch
from clast_plugins.generators.filling.room import Room

Floats = NDArray[np.float64]

SAG = 0.01
"""Overlap at the bottom under the weight of all, in primary diameters, while grains fall."""
LOOK = 100
SLOW = 0.002
"""Nothing falls any more: grains sink on average by less than this share of their own size in so many steps."""
LONGEST = 20_000
PACE = 0.02
"""How far the lid sinks in a step, in primary diameters."""


class Settled(NamedTuple):
    """How rigid grains came to rest: height that primaries reach and largest overlap in m, and steps taken."""

    height: float
    overlap: float
    steps: int


def settle(grains: Grains, room: Room, height: float | None, allowed: float) -> Settled:
    """Let grains settle, press down what stands out above a height, and push apart what overlaps.

    Parameters
    ----------
    grains : Grains
        Moved in place.
    room : Room
        Gets a lid where grains stand out above ``height``.
    height : float or None
        In m; None leaves the surface as it is.
    allowed : float
        Largest overlap wanted, in m.

    Returns
    -------
    Settled
        Compare ``overlap`` with ``allowed``: what does not fit stays overlapped.

    Raises
    ------
    PackingError
        If they do not stop sinking.
    """
    touch, minimiser = Touch(grains, room), Minimiser(grains)
    primary = 2.0 * float(grains.radius.mean())
    layers = max(1.0, float(grains.centre[:, 2].max()) / (2.0 * float(grains.reach.mean())))
    weight = SAG * primary / layers * minimiser.mass
    look = round(LOOK * max(1.0, np.sqrt(0.1 * layers)))  # the weight is smaller where many lie above each other
    steps = _fall(grains, touch, minimiser, weight, look)
    if height is not None and top(grains) > height:
        steps += _level(grains, touch, minimiser, weight, height, PACE * primary)
        steps += _fall(grains, touch, minimiser, weight, look)
    steps += _part(touch, minimiser, allowed)
    return Settled(top(grains), touch.overlap, steps)


def top(grains: Grains) -> float:
    """Return the height that primaries reach, in m."""
    return float((grains.positions()[:, 2] + grains.radius).max())


def _fall(grains: Grains, touch: Touch, minimiser: Minimiser, weight: Floats, look: int) -> int:
    """Let grains of these weights (g, 1) fall until they hardly sink from look to look; return the steps."""
    before = grains.centre[:, 2].copy()
    for step in range(1, LONGEST + 1):
        _step_under(touch, minimiser, weight)
        if step % look == 0:
            sunk = (before - grains.centre[:, 2]) / (2.0 * grains.reach)
            if float(sunk.mean()) < SLOW:
                return step
            before = grains.centre[:, 2].copy()
    raise PackingError(f"the grains did not settle within {LONGEST} steps; take another 'seed'", ("seed",))


def _level(grains: Grains, touch: Touch, minimiser: Minimiser, weight: Floats, height: float, pace: float) -> int:
    """Lower a lid onto the grains down to a height; return the steps."""
    touch.room.lid = top(grains)
    steps = 0
    while touch.room.lid > height:
        touch.room.lid = max(height, touch.room.lid - pace)
        _step_under(touch, minimiser, weight)
        steps += 1
    return steps


def _step_under(touch: Touch, minimiser: Minimiser, weight: Floats) -> None:
    touch.look()
    touch.force[:, 2:] -= weight
    minimiser.advance(touch.force, touch.torque)


def _part(touch: Touch, minimiser: Minimiser, allowed: float) -> int:
    """Push apart what overlaps, without weight, until nothing does or it gets no better; return the steps."""
    least, since = np.inf, 0
    for step in range(LONGEST):
        touch.look()
        if touch.overlap <= allowed or since > 20 * LOOK:
            return step
        least, since = (touch.overlap, 0) if touch.overlap < 0.9 * least else (least, since + 1)
        minimiser.advance(touch.force, touch.torque)
    return LONGEST


class Minimiser:
    """FIRE for rigid grains: steered towards the forces while these do work, stopped when they do not.

    Lengths are in m, the mass of a mean grain is 1, and a contact's stiffness is 1: so time has no unit. A step of 0.05
    follows the twenty or so contacts of a grain; where a longer one goes too far, velocities are dropped and the step
    is halved.
    """

    STEP, LONGEST = 0.05, 0.35

    def __init__(self, grains: Grains) -> None:
        self.grains = grains
        self.mass = (grains.volume / grains.volume.mean())[:, None]
        self.inertia = 0.4 * self.mass * (0.8 * grains.reach[:, None]) ** 2
        self.velocity, self.spin = np.zeros_like(grains.centre), np.zeros_like(grains.centre)
        self.farthest = 0.1 * float(grains.radius.min())
        self.step, self.steering, self.downhill = self.STEP, 0.1, 0

    def advance(self, force: Floats, torque: Floats) -> None:
        """Move the grains one step under forces and torques, (g, 3) each."""
        power = float((force * self.velocity).sum() + (torque * self.spin).sum())
        push, twist = force / self.mass, torque / self.inertia
        if power > 0.0:
            speed, pull = self._norm(self.velocity, self.spin), self._norm(push, twist)
            along = self.steering * speed / pull if pull > 0.0 else 0.0
            self.velocity = (1.0 - self.steering) * self.velocity + along * push
            self.spin = (1.0 - self.steering) * self.spin + along * twist
            self.downhill += 1
            if self.downhill > 5:
                self.step, self.steering = min(1.1 * self.step, self.LONGEST), 0.99 * self.steering
        else:
            self.velocity[:] = self.spin[:] = 0.0
            self.step, self.steering, self.downhill = 0.5 * self.step, 0.1, 0
            self.step = max(self.step, self.STEP)
        self.velocity += self.step * push
        self.spin += self.step * twist
        self._limit()
        self.grains.move(self.velocity, self.spin, self.step)

    def _norm(self, linear: Floats, angular: Floats) -> float:
        return float(np.sqrt((self.mass * linear**2).sum() + (self.inertia * angular**2).sum()))

    def _limit(self) -> None:
        """Let no surface go farther in one step than a tenth of a primary."""
        way = np.sqrt((self.velocity**2).sum(axis=1)) + self.grains.reach * np.sqrt((self.spin**2).sum(axis=1))
        share = np.minimum(1.0, self.farthest / np.maximum(self.step * way, 1e-300))[:, None]
        self.velocity *= share
        self.spin *= share
