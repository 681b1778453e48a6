"""Total kinematics: strain measures from positions and orientations alone, loads as their exact gradient."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast import hookimpl
from clast.maths.rotation import Matrix, matrix, relative, rotate, rotate_back
from clast.maths.vec3 import Vec, add, cross, dot, scale, sub
from clast.parts.bond_kinematics import BondKinematics, BondMotion, EndLoads
from clast.parts.bond_model import BondLoad, Strain
from clast.parts.params import Params
from clast.plugins.registry import Registry


class Total(Params):
    r"""Strains measured in the bond's material frame, with no history at all.

    Equation
    --------
    q_m = (q_i + q_j)/|q_i + q_j|,  θ = log(q_i⁻¹ q_j),  n = R(q_m)ᵀ d/|d|
    axial = |d| − L0,  shear = L0 (n − (n·n0) n0),  twist = θ·n0,  bending = θ − twist n0

    Symbols
    -------
    d : centre of j minus centre of i
    n0, L0 : its direction and length when the bond was made
    q_i, q_j : orientations of the ends, 1 when the bond was made
    q_m : rotation half-way between the ends

    The force on d is R(q_m) S with S = N n + (L0/|d|)(T − (T·n) n). With w = R(q_m)ᵀ d, c = S x w and the material
    moment M, the spin gradients of the ends are R(q_m)(c/2 ∓ v), v = P M − ½ τ c x θ, where P is the transposed
    derivative of the logarithm and τ = tan(|θ|/4)/|θ|. All are the gradient of one energy, so an elastic bond
    conserves it, and swapping i and j mirrors every bit.

    Limits
    ------
    Relative rotations of the ends below 180°, where the logarithm jumps to the other side. A bond that is turned
    farther breaks, whatever its model says, with the mode ``turned``.

    Source
    ------
    Rotter, Dosta, Düster (2023), Eqs. 3–6, for the stiffnesses; the half-way frame as for geometrically exact beams
    (Crisfield and Jelenić 1999, doi:10.1098/rspa.1999.0352); closed-form moments in docs/theory.md.
    """


class Reference(NamedTuple):
    """The undeformed bond: unit vector and length L0 in m."""

    n0: Vec
    L0: float


class Frame(NamedTuple):
    """What turns a load back into forces and moments: see :class:`Total`."""

    d: Vec
    R_m: Matrix
    n: Vec
    n0: Vec
    stretch: float
    t: Vec
    f: float
    h: float


def reference(d: NDArray[np.float64], L0: NDArray[np.float64]) -> Reference:
    """Return n0 and L0 of all bonds from (m, 3) centre vectors and (m,) lengths."""
    return Reference(d / np.linalg.norm(d, axis=1)[:, None], L0)  # type: ignore[arg-type]


def arctangent_rest(z: float) -> float:
    """Return (atan(√z)/√z − 1)/z to 6e-16 for 0 ≤ z ≤ 1: a rational least-squares fit."""
    p = -1.4309848311093869168e-05
    p = -0.0079588074025402917705 + z * p
    p = -0.10944152003281727279 + z * p
    p = -0.44093858552579755968 + z * p
    p = -0.66564702810544651989 + z * p
    p = -0.33333333333333259367 + z * p
    q = 0.0095316680297734674056
    q = 0.17784088753653611892 + z * q
    q = 1.0201285291798010737 + z * q
    q = 2.4524089786406002967 + z * q
    q = 2.5969410843155525807 + z * q
    q = 1.0 + z * q
    return p / q


def measure(motion: BondMotion, ref: Reference, state: None, dt: float) -> tuple[Strain, Frame, None]:
    """Return strain measures and frame of a bond; motion needs d, q_i and q_j only."""
    q_i, q_j = motion.q_i, motion.q_j
    p = relative(q_i, q_j)
    s = 1.0 if p[0] >= 0.0 else -1.0
    a = 1.0 + s * p[0]  # 2 cos²(θ/4)
    g = 1.0 / a  # 2/|q_i + s q_j|²
    both = (q_i[0] + s * q_j[0], q_i[1] + s * q_j[1], q_i[2] + s * q_j[2], q_i[3] + s * q_j[3])
    # t = tan(θ/4) along the axis of the relative rotation; θ = 4 t atan|t|/|t|
    t = scale(s * g, (p[1], p[2], p[3]))
    z = dot(t, t)
    h = -(1.0 + arctangent_rest(z) * (1.0 + z))
    f = 1.0 - h * z
    theta = scale(2.0 * a * f, t)

    R_m = matrix(both, g)
    length = sqrt(dot(motion.d, motion.d))
    per_length = 1.0 / length
    n = rotate_back(R_m, scale(per_length, motion.d))
    twist = dot(theta, ref.n0)
    strain = Strain(
        axial=length - ref.L0,
        shear=scale(ref.L0, sub(n, scale(dot(n, ref.n0), ref.n0))),
        twist=twist,
        bending=sub(theta, scale(twist, ref.n0)),
    )
    return strain, Frame(motion.d, R_m, n, ref.n0, ref.L0 * per_length, t, f, h), None


def beyond(motion: BondMotion) -> bool:
    """Tell whether the ends are turned against each other by more than 180°.

    Orientations are integrated from 1 on without a jump, so cos(θ/2) falls below 0 there.
    """
    return relative(motion.q_i, motion.q_j)[0] < 0.0


def end_loads(load: BondLoad, frame: Frame) -> EndLoads:
    """Return force and moments on the ends: minus the gradient of the bond's energy."""
    n, t = frame.n, frame.t
    T = load.shear
    S = add(scale(load.normal - frame.stretch * dot(T, n), n), scale(frame.stretch, T))
    M = add(scale(load.torsion, frame.n0), load.bending)
    pull = rotate(frame.R_m, S)
    lever = scale(0.5, cross(frame.d, pull))
    # P M = f M + h (t·M) t, and c x ½ τ θ = c x ½ t because τ θ = t; c = −2 lever, seen in space
    v = rotate(frame.R_m, add(scale(frame.f, M), scale(frame.h * dot(t, M), t)))
    v = add(v, cross(lever, rotate(frame.R_m, t)))
    return EndLoads(force=scale(-1.0, pull), moment_i=add(lever, v), moment_j=sub(lever, v))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer total kinematics."""
    registry.bond_kinematics(
        "total",
        BondKinematics(
            summary="strains from positions and orientations, no history, exact gradient",
            Params=Total,
            Reference=Reference,
            reference=reference,
            measure=measure,
            end_loads=end_loads,
            needs_orientation=True,
            beyond=beyond,
        ),
    )
