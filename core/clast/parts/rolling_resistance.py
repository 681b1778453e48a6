"""Rolling resistance: torques against the rolling of two touching bodies, whatever pushes them apart."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from clast.maths.vec3 import Vec
from clast.parts.contact_law import MaterialPair
from clast.parts.params import Params


class Pressing(NamedTuple):
    """What the contact law hands on to the rolling resistance.

    Attributes
    ----------
    limit : float
        Normal force that limits friction in N, at least 0.
    stiffness, stiffness_before : float
        Normal tangent stiffness in N/m, now and at the forces before; 0 for a part without a History.
    """

    limit: float
    stiffness: float
    stiffness_before: float


class RollingLoad(NamedTuple):
    """Torques on i and j in N m."""

    torque_i: Vec
    torque_j: Vec


class RollingLosses(NamedTuple):
    """What rolling has taken up for good since the forces before.

    Attributes
    ----------
    rolling : float
        Heat in J.
    stiffening : float
        What elastic energy loses because a stiffness changes while its spring is wound up, in J.
    drag : vector
        Torque on i in N m that stores no energy; it is handed back at the next evaluation.
    """

    rolling: float
    stiffening: float
    drag: Vec


@dataclass(frozen=True)
class RollingResistance:
    """The part a plugin registers with ``registry.rolling_resistance(name, RollingResistance(...))``.

    It is compiled where some pair of materials has rolling friction.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``contacts.rolling``.
    Constants : NamedTuple type
        Numbers of one pair of materials.
    constants : (params, pair) -> Constants
        Computed once per pair of materials.
    choices : (params) -> choices
        A NamedTuple of bools and ints that is a constant of the compiled loop.
    load : (touch, constants, history, pressing, dt, choices) -> (RollingLoad, history)
        From a :class:`clast.parts.contact_law.Touch` and a :class:`Pressing`.
    losses : (touch, constants, before, load, after, pressing, dt, choices, drag) -> RollingLosses
        What was dissipated since the forces before, for the energy ledger: from the history before and after, and the
        drag of the forces before.
    energy : (constants, history, radius, stiffness) -> float, optional
        Elastic energy in J, from the effective radius and the normal tangent stiffness; for a part with a History.
    History : NamedTuple type or None
        What a contact remembers while it lasts, all 0 at touch; vectors are tangential and the engine carries them
        with the contact plane. With it, ``touch.turned`` tells how far j has turned against i since the forces before.
    """

    summary: str
    Params: type[Params]
    Constants: type
    constants: Callable[[Any, MaterialPair], Any]
    choices: Callable[[Any], Any]
    load: Callable[..., Any]
    losses: Callable[..., RollingLosses]
    energy: Callable[..., float] | None = None
    History: type | None = None
