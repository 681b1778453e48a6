"""Frame: a scene at one recorded moment."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.maths.box import Box


class Frame(NamedTuple):
    """State of the scene at one recorded moment, in SI units.

    ``n`` particles, ``m`` bonds, ``w`` walls. A particle that has left the domain has NaN positions; in directions that
    are periodic it goes on, and ``position`` tells where its image in the box is.
    """

    time: float
    step: int
    strain: float
    position: NDArray[np.float32]
    """(n, 3), m"""
    orientation: NDArray[np.float32] | None
    """(n, 4) unit quaternions w, x, y, z, or None where the scene needs no orientation"""
    velocity: NDArray[np.float32]
    """(n, 3), m/s"""
    bond_intact: NDArray[np.bool_]
    """(m,)"""
    bond_stress: NDArray[np.float32]
    """(m,) axial stress in Pa, tension positive, 0 when broken"""
    bond_failure: NDArray[np.float32]
    """(m,) failure index: 0 unloaded, 1 breaks, 0 when broken"""
    wall_displacement: NDArray[np.float64]
    """(w, 3), m"""
    wall_orientation: NDArray[np.float64] | None
    """(w, 4) unit quaternions w, x, y, z that turn walls from the start, or None where none turns"""
    image: NDArray[np.int32]
    """(n, 3) how many boxes away each particle is; 0 in directions that are not periodic"""
    box: Box
    """The box that repeats itself, open space where none does"""

    @property
    def unwrapped(self) -> NDArray[np.float64]:
        """Where particles are that went on as they left the box, (n, 3) in m; grains are whole there."""
        return self.position + self.box.span * self.image

    def lines(self, pairs: NDArray[Any]) -> NDArray[np.float32]:
        """From the first particle of each pair, (k, 2), to the nearest image of the second, (k, 2, 3) in m."""
        first, second = self.position[pairs[:, 0]], self.position[pairs[:, 1]]
        return np.stack([first, self.box.beside(first, second).astype(np.float32)], axis=1)
