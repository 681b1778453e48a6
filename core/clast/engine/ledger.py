"""Energy ledger: where the work that went into a scene stays.

Elastic energies are state functions of the laws at the positions of the full step. Losses are summed up step by step
from each law's own rates. Nothing is computed as the rest, so what does not add up is an error, and is told.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.engine.kernels.layout import (
    APPLIED_WORK,
    BODY_WORK,
    BOND_VISCOUS,
    BOX_WORK,
    BRAKED,
    BROKEN,
    DRIVEN_WORK,
    DROPS,
    LEFT,
    PLASTIC,
    ROLLING,
    SLIDING,
    START,
    STIFFENING,
    VISCOUS,
    WALL_WORK,
    WOKEN,
)
from clast.engine.state import World


class Ledger(NamedTuple):
    """Energies of a scene since its start, all in J.

    Attributes
    ----------
    walls, driven, applied, body, box : float
        Work done on the scene by moving walls, by what drives prescribed particles, by constant forces and torques on
        particles, by gravity and other body forces, and by a periodic box that is stretched.
    start : float
        Kinetic and elastic energy at the start.
    woken : float
        Elastic energy that contacts begin with where a bond that stood in their stead breaks under pressure; only with
        ``contacts.bonded_pairs: false``.
    kinetic, contact_elastic, bond_elastic : float
        What is stored now. Contacts with walls count as contacts.
    contact_viscous, sliding, rolling, bond_viscous : float
        Heat of dashpots in contacts, of sliding and of rolling friction, of dashpots in bonds.
    contact_stiffening : float
        What tangential springs lose as contacts become softer and come apart, less what they gain as contacts become
        stiffer: Mindlin's tangential force is not the gradient of an energy.
    plastic, drops, broken : float
        What bonds lost by flow, plastic or by damage, and contacts by yielding; what bonds' stress drops released, what
        breaking bonds still held.
    braked : float
        What the damping of motion took.
    left : float
        What particles that left the domain took along, with their bonds.
    """

    walls: float
    driven: float
    applied: float
    body: float
    box: float
    start: float
    woken: float
    kinetic: float
    contact_elastic: float
    bond_elastic: float
    contact_viscous: float
    sliding: float
    rolling: float
    contact_stiffening: float
    bond_viscous: float
    plastic: float
    drops: float
    broken: float
    braked: float
    left: float

    @property
    def work(self) -> float:
        """Work done on the scene from outside."""
        return self.walls + self.driven + self.applied + self.body + self.box

    @property
    def given(self) -> float:
        """All that came in since the start: work, and the energy that contacts begin with as bonds break."""
        return self.work + self.woken

    @property
    def stored(self) -> float:
        """Kinetic and elastic energy."""
        return self.kinetic + self.contact_elastic + self.bond_elastic

    @property
    def dissipated(self) -> float:
        """What is gone: all heat and all energy set free."""
        contacts = self.contact_viscous + self.sliding + self.rolling + self.contact_stiffening
        return contacts + self.bond_viscous + self.plastic + self.drops + self.broken + self.braked + self.left

    @property
    def error(self) -> float:
        """What was put in and is neither stored nor dissipated."""
        return self.start + self.given - self.stored - self.dissipated

    @property
    def turnover(self) -> float:
        """What the error is measured by: the energy at the start and all that came in, whatever its sign."""
        came = abs(self.walls) + abs(self.driven) + abs(self.applied) + abs(self.body) + abs(self.box)
        return self.start + self.woken + came

    @property
    def closure(self) -> float:
        """Error as a share of the turnover; 0 where nothing was turned over."""
        return self.error / self.turnover if self.turnover > 0.0 else 0.0


def read_ledger(world: World, energies: NDArray[np.float64]) -> Ledger:
    """Return the ledger of a world.

    Parameters
    ----------
    world : World
    energies : (10,) float64
        What the kernel's ``energies`` tells: what is stored, and what was lost and done since the last booking.
    """
    kinetic, contact_elastic, bond_elastic = energies[:3].tolist()
    booked = world.ledger.sum(axis=0)
    booked[[VISCOUS, SLIDING, ROLLING, STIFFENING, PLASTIC, WALL_WORK, BOX_WORK]] += energies[3:]
    return Ledger(
        walls=float(booked[WALL_WORK]),
        driven=float(booked[DRIVEN_WORK]),
        applied=float(booked[APPLIED_WORK]),
        body=float(booked[BODY_WORK]),
        box=float(booked[BOX_WORK]),
        start=float(booked[START]),
        woken=float(booked[WOKEN]),
        kinetic=kinetic,
        contact_elastic=contact_elastic,
        bond_elastic=bond_elastic,
        contact_viscous=float(booked[VISCOUS]),
        sliding=float(booked[SLIDING]),
        rolling=float(booked[ROLLING]),
        contact_stiffening=float(booked[STIFFENING]),
        bond_viscous=float(booked[BOND_VISCOUS]),
        plastic=float(booked[PLASTIC]),
        drops=float(booked[DROPS]),
        broken=float(booked[BROKEN]),
        braked=float(booked[BRAKED]),
        left=float(booked[LEFT]),
    )
