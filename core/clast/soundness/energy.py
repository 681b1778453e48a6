"""Energy from nowhere: a scene must not hold more energy than it held before and was given since."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from clast.engine.kernels.layout import V, W
from clast.engine.ledger import Ledger
from clast.engine.state import World
from clast.engine.wall_frames import fastest_surface
from clast.scene.scene import Scene

SPARE = 2.0
STILL = 1e-9
QUADRATURE = 0.02
"""Share of all work, of either sign, by which its sum over the steps may be wrong."""


class Balance(NamedTuple):
    """What later looks are compared with, all in J.

    Attributes
    ----------
    held, given : float
        What the scene held, and all it had been given, at the look at which the difference was the smallest so far.
    last : float
        What it had been given at the last look.
    moved : float
        What has come in and gone out since the first of these looks, both counted as positive.
    """

    held: float
    given: float
    last: float
    moved: float


class EnergyWatch:
    """Compares the energy that a scene holds with what it held and was given before.

    Whatever is dissipated, energy held less energy given can only fall. So at every look it is compared with the look
    at which it was the smallest so far, wherever losses may have hidden a gain that is older than that.

    The energy at full steps is larger than that of the motion by up to 1/(1 − s²), s the share of the step in its
    limit; twice that is allowed. Work is booked up to the last force evaluation, as a sum over steps: as much as came
    in since the last look is allowed beside it, and ``QUADRATURE`` of all that came in and went out. What a driven wall
    or particle hits just then may hold energy that is booked one step later: at most that of everything thrown at twice
    the driver's speed.

    Parameters
    ----------
    scene : Scene
    share : float
        Time step over the limit of the scene at its start.

    Attributes
    ----------
    balance : Balance
        Part of a run's state: it is kept in checkpoints.
    """

    def __init__(self, scene: Scene, share: float) -> None:
        self.smallest, self.largest = float(scene.radius.min()), float(scene.radius.max())
        self.mass, self.driven = float(scene.mass.sum()), np.flatnonzero(scene.prescribed)
        self.allowed = SPARE / (1.0 - min(share, 0.95) ** 2) if share < 1.0 else SPARE
        self.balance = Balance(np.inf, 0.0, 0.0, 0.0)

    def note(self, ledger: Ledger) -> None:
        """Remember a look that was as it should be."""
        held, given = ledger.stored, ledger.given
        if held - given <= self.balance.held - self.balance.given:
            self.balance = Balance(held, given, given, 0.0)
        else:
            moved = self.balance.moved + abs(given - self.balance.last)
            self.balance = self.balance._replace(last=given, moved=moved)

    def complaint(self, ledger: Ledger, world: World) -> str | None:
        """Return how much too much there is."""
        before, held, given = self.balance, ledger.stored, ledger.given
        lately = abs(given - before.last)
        doubtful = lately + QUADRATURE * (before.held + before.moved + lately) + self._thrown(world)
        due = max(before.held + given - before.given, 0.0)
        if held <= self.allowed * (due + doubtful):
            return None
        came = f"it held {before.held:.3g} J before and was given {given - before.given:.3g} J since"
        return f"it holds {held:.3g} J, but {came}: energy came from nowhere"

    def _thrown(self, world: World) -> float:
        """Return the energy of all particles at twice the speed of the fastest driver, in J; least is round-off."""
        driven = world.particles.twist[self.driven]
        surface = driven[:, V : V + 3], self.largest * driven[:, W : W + 3], fastest_surface(world.walls)
        fastest = max(float(np.abs(each).max(initial=0.0)) for each in surface)
        return 2.0 * self.mass * max(fastest, STILL * self.smallest / world.numbers.dt) ** 2
