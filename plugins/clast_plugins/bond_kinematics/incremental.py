"""Incremental kinematics: shear, twist and bending summed up from velocities, step by step."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast import hookimpl
from clast.maths.rotation import chord, spin_about, swing
from clast.maths.vec3 import Vec, add, cross, dot, scale, sub
from clast.parts.bond_kinematics import BondKinematics, BondMotion, EndLoads
from clast.parts.bond_model import BondLoad, Strain
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Incremental(Params):
    r"""Strains summed up over the steps in a frame that is carried with the bond.

    Equation
    --------
    axial = |d| − L0;  Δu = (v_j − v_i) Δt − c x d̄ across the bond;  Δθ = (ω_j − ω_i) Δt

    c is the rotation vector ½(ω_i + ω_j) Δt, made 2 tan(φ/2) long for its angle φ: rigid motion leaves Δu = 0 at any
    step. A bar is the mean of both ends of the interval Δt between two force evaluations; v and ω are those with which
    the ends moved in it. The sums are components along n̄ = d/|d|, ē1 and ē2, e2 = n x e1. The frame follows the exact
    swing of n and the mean spin of the ends about it, so nothing that is summed is ever rotated.

    Limits
    ------
    Of second order with every integrator that moves particles with one velocity from one force evaluation to the next,
    as all built-in ones do (``clast bench --only pair`` shows it). Energy is not exactly conserved, and the strains
    are those of ``total`` only while they are small. For comparison with other programs.

    Source
    ------
    Rotter, Dosta, Düster (2023), Eqs. 3–6.
    """


class Reference(NamedTuple):
    """The undeformed bond: length L0 in m."""

    L0: float


class State(NamedTuple):
    """Carried frame (n, e1), shear components in m, twist and bending components in rad."""

    n: Vec
    e1: Vec
    u1: float
    u2: float
    twist: float
    b1: float
    b2: float


class Frame(NamedTuple):
    """Centre vector d in m and the three directions of the bond."""

    d: Vec
    n: Vec
    e1: Vec
    e2: Vec


def reference(d: NDArray[np.float64], L0: NDArray[np.float64]) -> Reference:
    """Return L0 of all bonds."""
    return Reference(L0)  # type: ignore[arg-type]


def start(d: NDArray[np.float64], L0: NDArray[np.float64]) -> State:
    """Return the frame of the undeformed bonds, nothing summed up."""
    n = d / np.linalg.norm(d, axis=1)[:, None]
    helper = np.zeros_like(n)
    helper[np.arange(len(n)), np.argmin(np.abs(n), axis=1)] = 1.0
    e1 = np.cross(n, helper)
    e1 /= np.linalg.norm(e1, axis=1)[:, None]
    nothing = np.zeros(len(n))
    return State(n, e1, nothing, nothing, nothing, nothing, nothing)  # type: ignore[arg-type]


def measure(motion: BondMotion, ref: Reference, state: State, dt: float) -> tuple[Strain, Frame, State]:
    """Return strain measures, frame and new sums of a bond; increments belong to the middle of the interval."""
    d = motion.d
    length = sqrt(dot(d, d))
    n = scale(1.0 / length, d)
    turned = chord(scale(0.5, add(motion.w_i, motion.w_j)), dt)
    mean_n = half_way(state.n, n)
    e1 = spin_about(swing(state.e1, state.n, n), n, dot(turned, mean_n))
    e2 = cross(n, e1)
    mean_e1, mean_e2 = half_way(state.e1, e1), half_way(cross(state.n, state.e1), e2)
    moved = scale(dt, motion.v)
    slip = sub(moved, cross(turned, sub(d, scale(0.5, moved))))
    turn = scale(dt, sub(motion.w_j, motion.w_i))
    new = State(
        n=n,
        e1=e1,
        u1=state.u1 + dot(slip, mean_e1),
        u2=state.u2 + dot(slip, mean_e2),
        twist=state.twist + dot(turn, mean_n),
        b1=state.b1 + dot(turn, mean_e1),
        b2=state.b2 + dot(turn, mean_e2),
    )
    strain = Strain(length - ref.L0, (0.0, new.u1, new.u2), new.twist, (0.0, new.b1, new.b2))
    return strain, Frame(d, n, e1, e2), new


def half_way(a: Vec, b: Vec) -> Vec:
    """Return the mean of two vectors."""
    return scale(0.5, add(a, b))


def end_loads(load: BondLoad, frame: Frame) -> EndLoads:
    """Return the force on j and the moments on both ends; the lever arm is half of d at each end."""
    T, M_b = load.shear, load.bending
    pull = add(scale(load.normal, frame.n), add(scale(T[1], frame.e1), scale(T[2], frame.e2)))
    moment = add(scale(load.torsion, frame.n), add(scale(M_b[1], frame.e1), scale(M_b[2], frame.e2)))
    lever = scale(0.5, cross(frame.d, pull))
    return EndLoads(scale(-1.0, pull), add(lever, moment), sub(lever, moment))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer incremental kinematics."""
    registry.bond_kinematics(
        "incremental",
        BondKinematics(
            summary="shear, twist and bending summed up from velocities, as in the paper",
            Params=Incremental,
            Reference=Reference,
            reference=reference,
            measure=measure,
            end_loads=end_loads,
            State=State,
            start=start,
            needs_velocity=True,
        ),
    )
