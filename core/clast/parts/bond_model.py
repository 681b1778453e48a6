"""Bond model: what the deformation of a bond costs, and when it breaks.

A law is a set of pure functions over numbers. It sees neither particles nor velocities nor the time step, so the same
file serves any kinematics, any integrator and a static solver. The functions run compiled in the step loop and plain
in Python, with the same bits.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.maths.vec3 import Vec
from clast.parts.params import Params

Each = Any
"""One number for all bonds, or an (m,) float64 array with one a bond."""


class Strain(NamedTuple):
    """How a bond is deformed, measured in its material frame by the kinematics.

    Attributes
    ----------
    axial : float
        Elongation |d| − L0 in m, tension positive.
    shear : vector
        Sideways displacement of end j against end i in m, perpendicular to the bond.
    twist : float
        Angle about the bond in rad.
    bending : vector
        Angle across the bond in rad.
    """

    axial: float
    shear: Vec
    twist: float
    bending: Vec


class BondLoad(NamedTuple):
    """What a bond carries: the derivatives of its energy with respect to the four strain measures.

    Attributes
    ----------
    normal : float
        N, tension positive.
    shear : vector
        N.
    torsion : float
        N m.
    bending : vector
        N m.
    """

    normal: float
    shear: Vec
    torsion: float
    bending: Vec


class BondGeometry(NamedTuple):
    """Shape of all bonds: cylinders of radius R between two centres.

    Attributes
    ----------
    L0 : (m,) float64
        Initial length in m.
    R, A, I : float or (m,) float64
        Radius in m, section πR² in m², second moment of area πR⁴/4 in m⁴; one number when all bonds agree.
    """

    L0: Each
    R: Each
    A: Each
    I: Each  # noqa: E741


class Stiffness(NamedTuple):
    """Elastic stiffness of each bond against each strain measure, (m,) float64: N/m, N/m, N m/rad, N m/rad."""

    axial: NDArray[np.float64]
    shear: NDArray[np.float64]
    torsion: NDArray[np.float64]
    bending: NDArray[np.float64]


class Dashpots(NamedTuple):
    """Viscosity of each bond against the rate of each strain measure, (m,) float64: N s/m, N s/m, N m s, N m s."""

    axial: NDArray[np.float64]
    shear: NDArray[np.float64]
    torsion: NDArray[np.float64]
    bending: NDArray[np.float64]


class RandomKey(NamedTuple):
    """What makes a bond's random numbers its own: see :func:`clast.maths.counter_random.uniform`."""

    seed: int
    bond: int


@dataclass(frozen=True)
class BondModel:
    """The part a plugin registers with ``registry.bond_model(name, BondModel(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``bonds.model``.
    Constants : NamedTuple type
        Numbers the law needs: floats, vectors, or NamedTuples of them.
    constants : (params, geometry) -> Constants
        Computed once; each field is one number for all bonds or an array with one entry a bond. Where parameters
        scatter (``bonds.scatter``) they are (m,) arrays too; a model that cannot take these is asked bond by bond.
    stiffness : (params, geometry) -> Stiffness
        For the time step, the damping and static solvers; takes scattered parameters as ``constants`` does.
    load : (strain, constants, state) -> BondLoad
        Gradient of ``energy``.
    failure : (strain, load, constants, state) -> float
        Continuous failure index: 0 unloaded, breaks at 1.
    mode : (strain, load, constants, state) -> int
        Which of ``modes`` broke it.
    energy : (strain, constants, state) -> float
        Elastic energy in J.
    modes : tuple of str
        Names of the ways to break.
    State : NamedTuple type or None
        History of a bond: floats, vectors, or NamedTuples of them, all 0 at the start. None costs nothing.
    flow : (strain, constants, state) -> State, optional
        Continuous change of the state (plastic flow), before the load is computed.
    overload : (strain, constants, state) -> float, optional
        Above 1 a discrete event is due.
    on_event : (strain, constants, state, key) -> State, optional
        One discrete event, e.g. a stress drop; repeated while ``overload`` stays above 1.
    dashpots : (params, geometry) -> Dashpots, optional
        Viscous loads beside ``load``, in proportion to the rates of the strain measures; those of ``bonds.damping`` are
        added. ``failure`` does not see them. Takes scattered parameters as ``constants`` does.
    misfit : (params, geometry) -> str or None, optional
        Why some bond of this geometry cannot have these parameters, and what to change; None where all can. Takes
        scattered parameters as arrays, as ``constants`` does.
    variant : (params) -> BondModel, optional
        The law for given parameters, which takes the place of this one: what an option needs of state and arithmetic
        costs nothing where it is not chosen.
    """

    summary: str
    Params: type[Params]
    Constants: type
    constants: Callable[[Any, BondGeometry], Any]
    stiffness: Callable[[Any, BondGeometry], Stiffness]
    load: Callable[..., BondLoad]
    failure: Callable[..., float]
    mode: Callable[..., int]
    energy: Callable[..., float]
    modes: tuple[str, ...]
    State: type | None = None
    flow: Callable[..., Any] | None = None
    overload: Callable[..., float] | None = None
    on_event: Callable[..., Any] | None = None
    dashpots: Callable[[Any, BondGeometry], Dashpots] | None = None
    misfit: Callable[[Any, BondGeometry], str | None] | None = None
    variant: Callable[[Any], BondModel] | None = None
