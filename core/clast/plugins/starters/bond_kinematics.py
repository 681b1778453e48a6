"""Starter: strains of a bond seen from its first end."""

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

CLAST_API = 1


class Starter(Params):
    """Strains in the frame that turns with end i.

    Equation
    --------
    n = R(q_i)ᵀ d/|d|,  θ = 2 p for the vector part p of q_i⁻¹ q_j
    axial = |d| − L0,  shear = L0 (n − (n·n0) n0),  twist = θ·n0,  bending = θ − twist n0

    Symbols
    -------
    d : centre of j minus centre of i; n0, L0 its direction and length when the bond was made
    q_i, q_j : orientations of the ends, 1 when the bond was made

    Limits
    ------
    Ends that turn little against each other; shear is measured against end i, so swapping the ends changes it.

    Source
    ------
    Name where the kinematics was published.
    """


class Reference(NamedTuple):
    """The undeformed bond: unit vector and length in m."""

    n0: Vec
    L0: float


class Frame(NamedTuple):
    """What ``end_loads`` needs again."""

    d: Vec
    R_i: Matrix
    n: Vec
    stretch: float
    n0: Vec


def reference(d: NDArray[np.float64], L0: NDArray[np.float64]) -> Reference:
    """Return n0 and L0 of all bonds from (m, 3) centre vectors and (m,) lengths."""
    return Reference(d / np.linalg.norm(d, axis=1)[:, None], L0)  # type: ignore[arg-type]


def measure(motion: BondMotion, ref: Reference, state: None, dt: float) -> tuple[Strain, Frame, None]:
    """Return the strains, what ``end_loads`` needs, and the state."""
    R_i, length = matrix(motion.q_i, 2.0), sqrt(dot(motion.d, motion.d))
    n = rotate_back(R_i, scale(1.0 / length, motion.d))
    p = relative(motion.q_i, motion.q_j)
    theta = (2.0 * p[1], 2.0 * p[2], 2.0 * p[3])
    twist = dot(theta, ref.n0)
    strain = Strain(
        axial=length - ref.L0,
        shear=scale(ref.L0, sub(n, scale(dot(n, ref.n0), ref.n0))),
        twist=twist,
        bending=sub(theta, scale(twist, ref.n0)),
    )
    return strain, Frame(motion.d, R_i, n, ref.L0 / length, ref.n0), None


def end_loads(load: BondLoad, at: Frame) -> EndLoads:
    """Return force and moments on the ends: minus the derivatives of the energy."""
    T = load.shear
    S = add(scale(load.normal - at.stretch * dot(T, at.n), at.n), scale(at.stretch, T))
    pull, moment = rotate(at.R_i, S), rotate(at.R_i, add(scale(load.torsion, at.n0), load.bending))
    return EndLoads(scale(-1.0, pull), add(moment, cross(at.d, pull)), scale(-1.0, moment))


@hookimpl
def clast_register(registry: Registry) -> None:
    """Offer the kinematics."""
    registry.bond_kinematics(
        "starter",
        BondKinematics(
            summary="strains seen from the first end",
            Params=Starter,
            Reference=Reference,
            reference=reference,
            measure=measure,
            end_loads=end_loads,
            needs_orientation=True,
        ),
    )
