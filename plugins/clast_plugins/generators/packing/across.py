"""Across the faces of a periodic box: spheres near one face are seen beyond the other, and pushed from there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast.engine.near_pairs import with_images
from clast.maths.box import Box
from clast_plugins.generators.packing.room import Floats


class Seen:
    """Spheres, and behind them images of those near the lower faces; in open space the spheres alone.

    Parameters
    ----------
    position : (n, 3) float64
        Centres, anywhere.
    far : float
        How far apart two centres may be at the most that count as near.
    box : Box

    Attributes
    ----------
    which : (n + k,) int64
        The sphere that each is.
    """

    def __init__(self, position: Floats, far: float, box: Box) -> None:
        self.which: NDArray[np.int64] = np.arange(len(position))
        self._shift: Floats | None = None
        if box.repeats:
            seen, self.which = with_images(box.wrapped(position), far, box)
            self._shift = seen - position[self.which]

    def places(self, position: Floats) -> Floats:
        """Return the centres of all, (n + k, 3)."""
        return position if self._shift is None else np.asarray(position[self.which] + self._shift)

    def gathered(self, force: Floats) -> Floats:
        """Return the sum of the forces (n + k, 3) on each sphere and its images, (n, 3)."""
        if self._shift is None:
            return force
        count = int(self.which.max(initial=-1)) + 1
        return np.column_stack([np.bincount(self.which, force[:, c], count) for c in range(3)])

    def once(self, pairs: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return pairs of what is seen, (p, 2), each two spheres once."""
        if self._shift is None:
            return pairs
        _, first = np.unique(np.sort(self.which[pairs], axis=1), axis=0, return_index=True)
        return np.asarray(pairs[np.sort(first)])
