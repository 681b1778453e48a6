"""Energy ledger: where the work that went into a scene stays.

Elastic energies are state functions of the laws at the positions of the full step. Losses are summed up step by step
from each law's own rates. Nothing is computed as the rest, so what does not add up is an error, and is told.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from clast.engine.kernels.layout import (
    APPLIED_WORK,
    BODY_WORK,
    BOND_VISCOUS,
    BROKEN,
    DRIVEN_WORK,
    DROPS,
    INVERSE_INERTIA,
    INVERSE_MASS,
    LEFT,
    PLASTIC,
    ROLLING,
    SLIDING,
    START,
    STIFFENING,
    VISCOUS,
    WALL_WORK,
    V,
    W,
)
from clast.engine.state import Particles, World


class Ledger(NamedTuple):
    """Energies of a scene since its start, all in J.

    Attributes
    ----------
    walls, driven, applied, body : float
        Work done on the scene by moving walls, by what drives prescribed particles, by constant forces and torques on
        particles, and by gravity and other body forces.
    start : float
        Kinetic and elastic energy at the start.
    kinetic, contact_elastic, bond_elastic : float
        What is stored now. Contacts with walls count as contacts.
    contact_viscous, sliding, rolling, bond_viscous : float
        Heat of dashpots in contacts, of sliding and of rolling friction, of dashpots in bonds.
    contact_stiffening : float
        What tangential springs lose as contacts become softer, less what they gain as contacts become stiffer:
        Mindlin's tangential force is not the gradient of an energy.
    plastic, drops, broken : float
        Plastic work of bonds, what their stress drops released, what breaking bonds still held.
    left : float
        What particles that left the domain took along, with their bonds.
    """

    walls: float
    driven: float
    applied: float
    body: float
    start: float
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
    left: float

    @property
    def work(self) -> float:
        """Work done on the scene from outside."""
        return self.walls + self.driven + self.applied + self.body

    @property
    def stored(self) -> float:
        """Kinetic and elastic energy."""
        return self.kinetic + self.contact_elastic + self.bond_elastic

    @property
    def dissipated(self) -> float:
        """What is gone: all heat and all energy set free."""
        contacts = self.contact_viscous + self.sliding + self.rolling + self.contact_stiffening
        return contacts + self.bond_viscous + self.plastic + self.drops + self.broken + self.left

    @property
    def error(self) -> float:
        """What was put in and is neither stored nor dissipated."""
        return self.start + self.work - self.stored - self.dissipated

    @property
    def turnover(self) -> float:
        """What the error is measured by: the energy at the start and all work, whatever its sign."""
        return self.start + abs(self.walls) + abs(self.driven) + abs(self.applied) + abs(self.body)

    @property
    def closure(self) -> float:
        """Error as a share of the turnover; 0 where nothing was turned over."""
        return self.error / self.turnover if self.turnover > 0.0 else 0.0


def read_ledger(world: World, contact_elastic: float, bond_elastic: float) -> Ledger:
    """Return the ledger of a world whose elastic energies in J are known."""
    booked = world.ledger.sum(axis=0)
    stored = kinetic_energy(world.particles, world.numbers.dt), contact_elastic, bond_elastic
    return Ledger(
        walls=float(booked[WALL_WORK]),
        driven=float(booked[DRIVEN_WORK]),
        applied=float(booked[APPLIED_WORK]),
        body=float(booked[BODY_WORK]),
        start=float(booked[START]),
        kinetic=stored[0],
        contact_elastic=stored[1],
        bond_elastic=stored[2],
        contact_viscous=float(booked[VISCOUS]),
        sliding=float(booked[SLIDING]),
        rolling=float(booked[ROLLING]),
        contact_stiffening=float(booked[STIFFENING]),
        bond_viscous=float(booked[BOND_VISCOUS]),
        plastic=float(booked[PLASTIC]),
        drops=float(booked[DROPS]),
        broken=float(booked[BROKEN]),
        left=float(booked[LEFT]),
    )


def kinetic_energy(particles: Particles, dt: float) -> float:
    """Return the kinetic energy in J of all particles that forces can move, scaled masses included.

    Taken as ½ m (v − ½ a dt)·(v + ½ a dt): the mean velocities of the steps before and after. A vibration whose period
    spans few steps keeps its energy in this form; ½ m v² alone exceeds it by (ω dt)²/4.
    """
    total = 0.0
    for inverse, first in ((INVERSE_MASS, V), (INVERSE_INERTIA, W)):
        per = particles.body[:, inverse]
        inertia = np.divide(1.0, per, out=np.zeros_like(per), where=per > 0.0)
        rate, change = (table[:, first : first + 3] for table in (particles.twist, particles.acceleration))
        total += 0.5 * float((inertia * (rate**2 - (0.5 * dt * change) ** 2).sum(axis=1)).sum())
    return total
