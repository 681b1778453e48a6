"""What one scene needs compiled: its parts, and the features that decide what is left out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from clast.engine.records import width
from clast.parts.body_force import BodyForce
from clast.parts.bond_kinematics import BondKinematics
from clast.parts.bond_model import BondModel
from clast.parts.contact_law import ContactLaw, Features
from clast.parts.damping import Damping
from clast.parts.integrator import Integrator
from clast.parts.motion import Motion
from clast.parts.rolling_resistance import RollingResistance
from clast.parts.wall import Wall

TURNED = "turned"
"""Crack mode of a bond whose ends moved beyond what its kinematics can measure."""


@dataclass(frozen=True)
class BondPlan:
    """How bonds are computed.

    Attributes
    ----------
    uniform : tuple of bool
        For each number of the model's constants, whether all bonds share it.
    damping, fade : bool
        Whether dashpots act, and whether breaking bonds let go over several steps.
    books : bool
        Whether a bond keeps the loads of its dashpots until the next force evaluation, for the energy ledger.
    """

    model: BondModel
    kinematics: BondKinematics
    uniform: tuple[bool, ...]
    damping: bool = False
    fade: bool = False
    books: bool = False

    @property
    def crack_modes(self) -> tuple[str, ...]:
        """Names of what can break a bond: those of its model, and last the limit of its kinematics if it has one."""
        return (*self.model.modes, *((TURNED,) if self.kinematics.beyond is not None else ()))


@dataclass(frozen=True)
class ContactPlan:
    """How contacts are computed.

    Attributes
    ----------
    choices : NamedTuple
        Constants of the compiled law.
    rolling, rolling_choices : RollingResistance and NamedTuple, or None
        What resists rolling, where something does, and its constants.
    bonded_pairs, between_particles : bool
        Whether bonded particles touch too, and whether there are two particles at all.
    one_material : bool
        Whether all particles are of one material, so that one row of constants serves all their contacts.
    one_size : bool
        Whether all particles have one radius and one mass, so that they are no matter of single contacts.
    rests : bool
        Whether some pairs overlap at the start without pushing.
    """

    law: ContactLaw
    features: Features
    choices: Any
    rolling: RollingResistance | None = None
    rolling_choices: Any = None
    bonded_pairs: bool = True
    between_particles: bool = True
    one_material: bool = True
    one_size: bool = True
    rests: bool = False

    @property
    def remembers(self) -> bool:
        """Whether the history of the law is stored."""
        return self.law.History is not None and (self.features.sliding or self.law.yields)

    @property
    def reaches(self) -> bool:
        """Whether contacts hold beyond touch."""
        return self.law.reach is not None

    @property
    def history(self) -> int:
        """Numbers that law and rolling resistance remember of a contact."""
        rolled = width(self.rolling.History) if self.rolling is not None else 0
        return (width(self.law.History) if self.remembers else 0) + rolled

    @property
    def constants(self) -> int:
        """Numbers of one pair of materials."""
        return width(self.law.Constants) + (width(self.rolling.Constants) if self.rolling is not None else 0)

    def turns(self, ledger: bool) -> bool:
        """Tell whether it matters how far bodies turn against each other."""
        wound = self.rolling is not None and self.rolling.History is not None
        return wound or (ledger and self.features.rolling)


@dataclass(frozen=True)
class Blueprint:
    """Everything the assembler needs to know; run-time numbers are not part of it.

    ``applied_loads`` is whether a constant force or torque acts on some particle, ``ledger`` whether energies are
    booked, ``chunked`` whether the scene is cut into chunks that threads can share, ``periodic`` whether it repeats
    itself in some direction, ``stretches`` whether the box in which it does is stretched, ``curved_walls`` whether some
    wall is not flat, ``step_share`` what damping of motion and walls that give way leave of the stable step.
    """

    integrator: Integrator
    bonds: BondPlan | None = None
    contacts: ContactPlan | None = None
    walls: tuple[Wall, ...] = ()
    motions: tuple[Motion, ...] = ()
    body_forces: tuple[BodyForce, ...] = ()
    applied_loads: bool = False
    ledger: bool = False
    chunked: bool = False
    periodic: bool = False
    stretches: bool = False
    curved_walls: bool = False
    damping: Damping | None = None
    step_share: float = 1.0

    def damping_factor(self, zeta: float) -> float:
        """Return the stable step of an oscillator with damping ratio ζ as a share of 2/ω: of integrator and damping."""
        return self.step_share * self.integrator.damping_factor(zeta)

    @property
    def manifolds(self) -> bool:
        """Whether particles can touch some wall in several places."""
        return any(wall.touches is not None for wall in self.walls)

    @property
    def answering(self) -> bool:
        """Whether some wall answers to the force on it."""
        return any(motion.answer is not None for motion in self.motions)

    @property
    def walls_turn(self) -> bool:
        """Whether some wall turns."""
        return any(motion.turns for motion in self.motions)

    @property
    def turned_by_moments(self) -> bool:
        """Whether some wall turns as the moment on it wants."""
        return any(motion.answer_spin is not None for motion in self.motions)

    @property
    def orientation(self) -> bool:
        """Whether orientations are integrated."""
        return self.bonds is not None and self.bonds.kinematics.needs_orientation

    @property
    def spin(self) -> bool:
        """Whether particles spin."""
        return self.bonds is not None or self.friction or self.applied_loads or self.body_loads

    @property
    def body_loads(self) -> bool:
        """Whether some body force is a load on each particle, of its own size."""
        return any(force.load is not None for force in self.body_forces)

    @property
    def friction(self) -> bool:
        """Whether contacts slide or roll with resistance."""
        return self.contacts is not None and (self.contacts.features.sliding or self.contacts.features.rolling)

    @property
    def bond_velocity(self) -> bool:
        """Whether bonds see how their ends move: where kinematics sums it up, or the work of what flows is booked."""
        if self.bonds is None:
            return False
        return self.bonds.kinematics.needs_velocity or (self.ledger and self.bonds.model.flow is not None)

    @property
    def velocity_forces(self) -> bool:
        """Whether any force depends on velocities."""
        damped_contacts = self.contacts is not None and (self.contacts.features.damping or self.friction)
        damped_bonds = self.bonds is not None and self.bonds.damping
        return damped_contacts or damped_bonds or bool(self.body_forces) or self.damping is not None

    @property
    def history(self) -> int:
        """Numbers that contacts remember of what their laws say."""
        return 0 if self.contacts is None else self.contacts.history

    @property
    def remembered(self) -> int:
        """Numbers that a contact keeps from one force evaluation to the next: its normal, its history, its drag.

        A contact that holds beyond touch is known by what it keeps.
        """
        books = self.ledger and self.contacts is not None and self.contacts.law.losses is not None
        drag = 6 if self.contacts is not None and self.contacts.features.rolling else 3
        kept = self.history + (drag if books else 0)
        reaches = self.contacts is not None and self.contacts.reaches
        return 3 + kept if kept or reaches else 0

    def functions(self) -> list[Callable[..., Any]]:
        """Return every function of the parts that is compiled."""
        found: list[Callable[..., Any] | None] = []
        if self.bonds is not None:
            model, kinematics = self.bonds.model, self.bonds.kinematics
            found += [
                kinematics.measure,
                kinematics.end_loads,
                kinematics.beyond,
                model.load,
                model.failure,
                model.mode,
                model.energy,
            ]
            found += [model.flow, model.overload, model.on_event]
        if self.contacts is not None:
            found += [self.contacts.law.load, self.contacts.law.energy, self.contacts.law.reach]
            found += [self.contacts.law.losses] if self.ledger else []
            found += _rolling_functions(self.contacts, self.ledger)
        found += [function for wall in self.walls for function in (wall.nearest, wall.touches)]
        found += [
            function
            for motion in self.motions
            for function in (motion.velocity, motion.way, motion.answer, motion.start)
        ]
        found += [
            function for motion in self.motions for function in (motion.spin, motion.answer_spin, motion.start_spin)
        ]
        found += [function for force in self.body_forces for function in (force.acceleration, force.load)]
        found += [self.damping.braking, self.damping.steering] if self.damping is not None else []
        return [function for function in found if function is not None]


def _rolling_functions(contacts: ContactPlan, ledger: bool) -> list[Callable[..., Any] | None]:
    rolling = contacts.rolling
    if rolling is None:
        return []
    stiffness = contacts.law.stiffness if rolling.History is not None else None
    return [rolling.load, rolling.energy, stiffness, rolling.losses if ledger else None]
