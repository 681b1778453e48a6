"""Bond kinematics: how the motion of two particles deforms the bond between them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.maths.rotation import Quat
from clast.maths.vec3 import Vec
from clast.parts.params import Params


class BondMotion(NamedTuple):
    """What the engine knows about the two ends i and j of a bond, at one instant.

    Attributes
    ----------
    d : vector
        From the centre of i to the centre of j, in m.
    q_i, q_j : quaternion
        Orientations, 1 at the start; given when the kinematics ``needs_orientation``.
    v : vector
        Velocity in m/s with which j moved against i since the forces before, dt ago: d was ``d − v dt`` then. Given
        when it ``needs_velocity``.
    w_i, w_j : vector
        Angular velocities in rad/s with which the ends turned since then; given when it ``needs_velocity``.
    """

    d: Vec
    q_i: Quat
    q_j: Quat
    v: Vec
    w_i: Vec
    w_j: Vec


class EndLoads(NamedTuple):
    """Force on end j (end i gets its opposite) in N, and the moments on both ends about their centres in N m."""

    force: Vec
    moment_i: Vec
    moment_j: Vec


@dataclass(frozen=True)
class BondKinematics:
    """The part a plugin registers with ``registry.bond_kinematics(name, BondKinematics(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``bonds.kinematics``.
    Reference : NamedTuple type
        Numbers that describe the undeformed bond.
    reference : (d, L0) -> Reference
        From (m, 3) centre vectors and (m,) initial lengths; fields (m,) or (m, 3).
    measure : (motion, reference, state, dt) -> (Strain, Frame, state)
        Strain measures, whatever ``end_loads`` needs again, and the new state.
    end_loads : (load, frame) -> EndLoads
        Gradient of the strain measures, applied to a load.
    State : NamedTuple type or None
        History of a bond; None costs nothing.
    start : (d, L0) -> State, optional
        State of the undeformed bond; all 0 when absent.
    needs_orientation, needs_velocity : bool
        What of :class:`BondMotion` must be gathered.
    beyond : (motion) -> bool, optional
        Whether the ends have moved so far that the strains tell nothing any more. Asked at every force evaluation; such
        a bond breaks whatever its model says, with the mode ``turned`` in the crack table.
    """

    summary: str
    Params: type[Params]
    Reference: type
    reference: Callable[[NDArray[np.float64], NDArray[np.float64]], Any]
    measure: Callable[..., Any]
    end_loads: Callable[..., EndLoads]
    State: type | None = None
    start: Callable[[NDArray[np.float64], NDArray[np.float64]], Any] | None = None
    needs_orientation: bool = False
    needs_velocity: bool = False
    beyond: Callable[[BondMotion], bool] | None = None
