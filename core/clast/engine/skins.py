"""Skins: how far neighbour lists reach beyond contact, and with it how long they last."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy as np

from clast.engine.kernels.layout import V
from clast.engine.state import Floats, Particles
from clast.errors import RunError

LEAST_SKIN = 0.1
"""Least way that a particle may go between two neighbour searches, as a share of the smallest radius."""

USUAL_SKIN, MOST_SKIN = 0.4, 2.0
"""The least and the most that it gets where there is room for it."""

STEPS = 400.0
"""How many steps at its present velocity a particle gets within these bounds."""


class Skin(NamedTuple):
    """How wide neighbour lists reach beyond contact, a side: bounds in m, and the steps a particle should be free.

    Particles get less than ``usual`` only where a periodic box leaves no room for it, but never less than ``least``.
    """

    least: float
    usual: float
    most: float
    steps: float


def choose_skin(wanted: float | Literal["auto"], smallest: float) -> Skin:
    """Return the skin of the neighbour lists: as wanted, or in shares of the smallest radius, in m.

    In a bed of 1.5 million bonds four times as wide a least skin makes a third more pairs and no step longer: pairs
    that do not touch are read in order, and forgotten.
    """
    if not isinstance(wanted, str):
        return Skin(0.5 * wanted, 0.5 * wanted, 0.5 * wanted, 0.0)
    return Skin(LEAST_SKIN * smallest, USUAL_SKIN * smallest, MOST_SKIN * smallest, STEPS)


def choose_slack(particles: Particles, skin: Skin, dt: float, room: float) -> Floats:
    """Return how far each particle may move before lists go stale, (n,) in m.

    A particle gets the way it makes in ``skin.steps`` steps, within the skin's bounds: the few fast fragments of a
    burst grain do not force a search every other step, and the many slow ones have short lists. ``room`` in m is what a
    periodic box allows.

    Raises
    ------
    RunError
        If that is less than the skin's least.
    """
    if room < skin.least:
        raise RunError(
            "a side of the periodic box has become so short that particles would meet each other in two images; end "
            "the run earlier, or begin with a larger box"
        )
    v = particles.twist[:, V : V + 3]
    way = skin.steps * dt * np.sqrt(np.einsum("ij,ij->i", v, v))
    return np.asarray(np.clip(way, min(skin.usual, room), min(skin.most, room)))
