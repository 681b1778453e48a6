"""What a packing is like: porosity, coordination number, overlaps."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.maths.box import Box
from clast.parts.generator import BondList
from clast.scene.bonding import close_pairs

Floats = NDArray[np.float64]


class Overlaps(NamedTuple):
    """Overlaps of a packing: how many pairs overlap, and the largest and mean overlap of those in m."""

    pairs: int
    largest: float
    mean: float


def overlaps(position: Floats, radius: Floats, box: Box | None = None) -> Overlaps:
    """Return number, largest and mean of the overlaps between particles.

    Parameters
    ----------
    position : (n, 3) float64
        Centres in m.
    radius : (n,) float64
        Radii in m.
    box : Box, optional
        Where it repeats itself, particles overlap across its faces too.

    Examples
    --------
    >>> overlaps(np.array([[0.0, 0.0, 0.0], [1.5, 0.0, 0.0]]), np.array([1.0, 1.0]))
    Overlaps(pairs=1, largest=0.5, mean=0.5)
    """
    _, gap = close_pairs(position, radius, 0.0, box)
    depth = -gap[gap < 0.0]
    if not len(depth):
        return Overlaps(0, 0.0, 0.0)
    return Overlaps(len(depth), float(depth.max()), float(depth.mean()))


def contact_coordination(position: Floats, radius: Floats, tolerance: float = 1e-3, box: Box | None = None) -> float:
    """Return the mean number of particles that touch a particle.

    Parameters
    ----------
    position : (n, 3) float64
        Centres in m.
    radius : (n,) float64
        Radii in m.
    tolerance : float
        Two particles touch when their gap is at most this share of the mean particle diameter.
    box : Box, optional
        Where it repeats itself, particles touch across its faces too.

    Examples
    --------
    >>> contact_coordination(np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [4.0, 0.0, 0.0]]), np.ones(3))
    1.3333333333333333
    """
    if not len(radius):
        return 0.0
    ends, _ = close_pairs(position, radius, tolerance * 2.0 * float(radius.mean()), box)
    return 2.0 * len(ends) / len(radius)


def bond_coordination(particles: int, bonds: BondList) -> float:
    """Return the mean number of bonds at a particle."""
    return 2.0 * len(bonds.ends) / particles if particles else 0.0


def porosity(radius: Floats, envelope: float) -> float:
    """Return the share of an envelope that particles of these radii leave free, overlaps not subtracted.

    Parameters
    ----------
    radius : (n,) float64
        Radii in m.
    envelope : float
        Volume of the envelope in m³.

    Examples
    --------
    361 primaries of 0.25 mm in a sphere of 2.16 mm:

    >>> round(porosity(np.full(361, 0.125e-3), sphere_volume(2.16e-3)), 4)
    0.4403
    """
    return 1.0 - math.fsum(4.0 / 3.0 * math.pi * radius**3) / envelope


def sphere_volume(diameter: float) -> float:
    """Return the volume of a sphere: π/6 d³."""
    return math.pi / 6.0 * diameter**3


def cut_sphere_surface(diameter: float, height: float) -> float:
    """Return the surface of a sphere between two planes at ± half the height, the two cuts included.

    >>> math.isclose(cut_sphere_surface(2.0, 2.0), 4.0 * math.pi)
    True
    """
    height = min(height, diameter)
    return math.pi * diameter * height + 0.5 * math.pi * (diameter**2 - height**2)


def cut_sphere_volume(diameter: float, height: float) -> float:
    """Return the volume of a sphere between two planes at ± half the height: π h (D²/4 − h²/12).

    >>> math.isclose(cut_sphere_volume(2.0, 2.0), sphere_volume(2.0))
    True
    """
    height = min(height, diameter)
    return math.pi * height * (diameter**2 / 4.0 - height**2 / 12.0)
