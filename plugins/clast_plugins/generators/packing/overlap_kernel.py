"""The compiled loops of the overlap relaxation: sums in list order, so their bits never depend on threads."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray


@njit(cache=True, error_model="numpy")  # type: ignore[misc,untyped-decorator,unused-ignore]
def push(
    position: NDArray[np.float64],
    radius: NDArray[np.float64],
    first: NDArray[np.int64],
    second: NDArray[np.int64],
    force: NDArray[np.float64],
) -> tuple[float, float]:
    """Write the force on each sphere; return the largest overlap and the overlap energy.

    Parameters
    ----------
    position : (n, 3) float64
        Centres.
    radius : (n,) float64
        Radii in the same unit.
    first, second : (p,) int64
        The pairs to look at.
    force : (n, 3) float64
        Overwritten: sum of overlap · unit vector away from the partner.
    """
    force[:] = 0.0
    largest = 0.0
    energy = 0.0
    for k in range(len(first)):
        i = first[k]
        j = second[k]
        x = position[i, 0] - position[j, 0]
        y = position[i, 1] - position[j, 1]
        z = position[i, 2] - position[j, 2]
        square = x * x + y * y + z * z
        reach = radius[i] + radius[j]
        if square >= reach * reach:
            continue
        distance = math.sqrt(square)
        overlap = reach - distance
        largest = max(largest, overlap)
        energy += 0.5 * overlap * overlap
        if distance == 0.0:
            continue
        share = overlap / distance
        force[i, 0] += share * x
        force[i, 1] += share * y
        force[i, 2] += share * z
        force[j, 0] -= share * x
        force[j, 1] -= share * y
        force[j, 2] -= share * z
    return largest, energy


@njit(cache=True, error_model="numpy")  # type: ignore[misc,untyped-decorator,unused-ignore]
def products(force: NDArray[np.float64], velocity: NDArray[np.float64]) -> tuple[float, float, float]:
    """Return the sums of force·velocity, force·force and velocity·velocity over all spheres."""
    power = 0.0
    force_square = 0.0
    speed_square = 0.0
    for i in range(len(force)):
        for c in range(3):
            power += force[i, c] * velocity[i, c]
            force_square += force[i, c] * force[i, c]
            speed_square += velocity[i, c] * velocity[i, c]
    return power, force_square, speed_square
