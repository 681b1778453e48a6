"""The contact network of a scene, as results hold it: what touches where, and with what force."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

GROUP = "contacts"
"""Where results hold the contacts of all frames, one after the other."""
ENDS = "contacts_end"
"""Dataset of the frames that tells how many contacts there are up to a frame and with it."""


class Contacts(NamedTuple):
    """Everything that touches at one moment: ``k`` contacts, those of walls last.

    The force on i is the opposite of that on j. Forces are those at the positions shown.
    """

    i: NDArray[np.uint32]
    """(k,) number of a particle"""
    j: NDArray[np.int32]
    """(k,) number of the other particle, or −1 − w for wall w in the order of ``Run.walls``"""
    position: NDArray[np.float32]
    """(k, 3) contact point in m"""
    force: NDArray[np.float32]
    """(k, 3) force on j in N"""
    normal_force: NDArray[np.float32]
    """(k,) its part from i towards j in N: pressure is positive"""
    tangential_force: NDArray[np.float32]
    """(k,) size of its part across in N"""

    @property
    def wall(self) -> NDArray[np.int32]:
        """Number of the wall of each contact, −1 between particles."""
        return np.where(self.j < 0, -1 - self.j, -1).astype(np.int32)


def grain_count(grain: NDArray[np.int64]) -> int:
    """Return how many grains there are; a particle that belongs to none is one of its own.

    >>> grain_count(np.array([0, 0, 1, -1, -1]))
    4
    """
    return len(np.unique(grain[grain >= 0])) + int((grain < 0).sum())
