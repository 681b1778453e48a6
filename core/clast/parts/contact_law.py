"""Contact law: what two touching bodies do to each other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from clast.maths.vec3 import ZERO, Vec, dot
from clast.parts.params import Params


class Touch(NamedTuple):
    """One contact between bodies i and j at one instant; j is the wall in a contact with a wall.

    Attributes
    ----------
    overlap : float
        δ > 0 in m; with a law that has a ``reach``, down to −reach while the contact holds.
    normal : vector
        Unit vector from i to j.
    velocity : vector
        Velocity of j against i at the contact point in m/s.
    spin_i, spin_j : vector
        Angular velocities in rad/s.
    radius : float
        Effective radius R* in m: R_i R_j / (R_i + R_j), R_i at a wall.
    radius_i, radius_j : float
        Radii in m; 0 for a wall.
    inverse_mass, inverse_inertia : float
        1/m* = 1/m_i + 1/m_j in 1/kg, 1/I* likewise in 1/(kg m²); walls and prescribed particles count as infinite.
    moved : vector
        How far j has moved against i at the contact point since the forces before, or since they met if that was
        later, in m, for tangential springs. Summing it up is of second order with every integrator; ``velocity`` times
        the step is not, because velocities may belong to the end of that time. Given when the law has a History that
        is stored, and for the energy ledger.
    turned : vector
        How far j has turned against i since the forces before, in rad. Given where particles roll with resistance, for
        the energy ledger and for a rolling resistance with a History.
    """

    overlap: float
    normal: Vec
    velocity: Vec
    spin_i: Vec
    spin_j: Vec
    radius: float
    radius_i: float
    radius_j: float
    inverse_mass: float
    inverse_inertia: float
    moved: Vec = ZERO
    turned: Vec = ZERO


def overlap_before(touch: Touch) -> float:
    """Return the overlap at the forces before in m, 0 where there was none."""
    return max(stretch_before(touch), 0.0)


def stretch_before(touch: Touch) -> float:
    """Return the overlap at the forces before in m, below 0 where the contact held beyond touch."""
    return touch.overlap + dot(touch.moved, touch.normal)


class ContactLoad(NamedTuple):
    """What a contact does to both bodies.

    Attributes
    ----------
    force : vector
        On j at the contact point, in N; i gets its opposite.
    torque_i, torque_j : vector
        Torques beyond that force's own moment, in N m.
    limit : float
        Normal force that limits friction, in N, at least 0: what a rolling resistance goes by. Told by a law that
        ``limits_rolling``.
    """

    force: Vec
    torque_i: Vec
    torque_j: Vec
    limit: float = 0.0


class Drag(NamedTuple):
    """What resists motion without storing energy: viscous force on j in N, rolling torque on i in N m.

    It is handed back at the next evaluation, so that heat is the mean of both times the way.
    """

    force: Vec
    torque: Vec


NO_DRAG = Drag(ZERO, ZERO)


class ContactLosses(NamedTuple):
    """Energy in J that a contact has taken up for good since the forces before.

    Attributes
    ----------
    viscous, sliding, rolling : float
        Heat of dashpots, of sliding and of rolling friction.
    stiffening : float
        What elastic energy loses because a stiffness changes while its spring is tense; negative where it gains. 0 for
        a law whose force is the gradient of its energy.
    drag : Drag
        The force as it resists what the contact moves; the torque is kept with rolling friction only, and is the
        rolling resistance's own.
    plastic : float
        Work of what yields. Told by a law that ``yields``.
    """

    viscous: float
    sliding: float
    rolling: float
    stiffening: float
    drag: Drag
    plastic: float = 0.0


class MaterialPair(NamedTuple):
    """What a law's constants are computed from: two materials and how they interact."""

    young_modulus_i: float
    poisson_ratio_i: float
    young_modulus_j: float
    poisson_ratio_j: float
    restitution: float
    sliding_friction: float
    rolling_friction: float


class Features(NamedTuple):
    """What the scene's materials need; what is False is neither compiled nor stored."""

    damping: bool
    sliding: bool
    rolling: bool


@dataclass(frozen=True)
class ContactLaw:
    """The part a plugin registers with ``registry.contact_law(name, ContactLaw(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``contacts.law``.
    Constants : NamedTuple type
        Numbers of one pair of materials.
    constants : (params, pair) -> Constants
        Computed once per pair of materials.
    choices : (params, features) -> choices
        A NamedTuple of bools and ints that is a constant of the compiled loop: ``if choices.sliding`` costs nothing,
        and what is not chosen is not compiled.
    load : (touch, constants, history, dt, choices) -> (ContactLoad, history)
    energy : (touch, constants, history, choices) -> float
        Elastic energy in J.
    stiffness : (constants, radius, overlap) -> float
        Normal tangent stiffness in N/m, for the time step.
    losses : (touch, constants, before, load, after, dt, choices, drag) -> ContactLosses, optional
        What one step dissipates, for the energy ledger: from the history before and after, and the drag of the forces
        before. Without it the ledger cannot close.
    damping : (params) -> bool, optional
        For a law that damps by parameters of its own: whether it does. Pairs then have no coefficient of restitution.
        Without it, a law damps where the coefficient of restitution of some pair is below 1.
    History : NamedTuple type or None
        What a contact remembers while it lasts, all 0 at touch; vectors are tangential and the engine carries them
        with the contact plane. Stored only when sliding friction is present, or where the law ``yields``.
    yields : bool
        Whether the normal force depends on the History; ``losses`` then tell what is ``plastic``.
    reach : (constants, radius) -> float, optional
        How far beyond touch a contact that has begun still holds, in m, for an effective radius; never less for a
        larger radius. The contact begins at overlap 0 and ends at −reach. ``energy`` counts from the touch; what it is
        as the contact ends is lost. Without it, contacts end where they begin.
    limits_rolling : bool
        Whether ``load`` tells the ``limit`` that a rolling resistance goes by; without it, rolling friction is the
        law's own business.
    """

    summary: str
    Params: type[Params]
    Constants: type
    constants: Callable[[Any, MaterialPair], Any]
    choices: Callable[[Any, Features], Any]
    load: Callable[..., Any]
    energy: Callable[..., float]
    stiffness: Callable[..., float]
    History: type | None = None
    losses: Callable[..., ContactLosses] | None = None
    damping: Callable[[Any], bool] | None = None
    yields: bool = False
    reach: Callable[..., float] | None = None
    limits_rolling: bool = False
