"""Box: where a scene lies, and in which directions it repeats itself."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Places = NDArray[np.floating[Any]]


class Box(NamedTuple):
    """A box with its edges along x, y and z; in a periodic direction it is followed by its own images.

    Attributes
    ----------
    lower, upper : (3,) float64
        Corners in m.
    periodic : (3,) bool
        Directions in which the scene repeats itself.

    Examples
    --------
    A particle near one face is near those at the other:

    >>> box = Box(np.zeros(3), np.array([10.0, 10.0, 10.0]), np.array([True, False, False]))
    >>> box.nearest(np.array([9.0, 9.0, 0.0])).tolist()
    [-1.0, 9.0, 0.0]
    >>> box.images(np.array([-1.0, -1.0, 5.0])).tolist(), box.wrapped(np.array([-1.0, -1.0, 5.0])).tolist()
    ([-1, 0, 0], [9.0, -1.0, 5.0])
    """

    lower: Floats
    upper: Floats
    periodic: NDArray[np.bool_]

    @property
    def repeats(self) -> bool:
        """Whether there is a periodic direction."""
        return bool(self.periodic.any())

    @property
    def span(self) -> Floats:
        """Distance from an image to the next, (3,) in m; 0 in directions that are not periodic."""
        return np.where(self.periodic, self.upper - self.lower, 0.0)

    @property
    def per_span(self) -> Floats:
        """Images in a metre, (3,) in 1/m; 0 in directions that are not periodic."""
        return np.where(self.periodic, 1.0 / np.where(self.periodic, self.upper - self.lower, 1.0), 0.0)

    @property
    def middle(self) -> Floats:
        """Middle of the sides, (3,) in m; 0 in directions that are not periodic."""
        lower, upper = (np.where(self.periodic, corner, 0.0) for corner in (self.lower, self.upper))
        return 0.5 * lower + 0.5 * upper

    @property
    def volume(self) -> float:
        """Volume in m³."""
        return float(np.prod(self.upper - self.lower))

    def per(self, length: float) -> Box:
        """Return the box in another unit of length."""
        return Box(self.lower / length, self.upper / length, self.periodic)

    def grown(self, span: Floats) -> Box:
        """Return the box with other distances from image to image, (3,) in m, about the same middle.

        The bounds stay to the bit where the distances do.
        """
        more = np.where(self.periodic, 0.5 * (span - self.span), 0.0)
        return Box(self.lower - more, self.upper + more, self.periodic)

    def nearest(self, way: Floats) -> Floats:
        """Return ways from one particle to another, (..., 3) in m, as they are to the nearest image of the other."""
        return np.asarray(way - self.span * np.rint(way * self.per_span))

    def along(self, way: Floats, axis: int) -> Floats:
        """Return such ways along one axis, (...) in m."""
        return (
            way if not self.periodic[axis] else np.asarray(way - self.span[axis] * np.rint(way * self.per_span[axis]))
        )

    def beside(self, first: Places, second: Places) -> Floats:
        """Return the images of the second positions, (..., 3) in m, that are nearest to the first ones."""
        return np.asarray(second - self.span * np.rint((second - first) * self.per_span))

    def images(self, position: Floats) -> NDArray[np.int64]:
        """Return how many boxes away from this one positions lie in each direction, (..., 3)."""
        lower = np.where(self.periodic, self.lower, 0.0)
        return np.asarray(np.floor((position - lower) * self.per_span), np.int64)

    def wrapped(self, position: Floats) -> Floats:
        """Return where positions, (..., 3) in m, lie within the box; unchanged in directions that do not repeat."""
        return np.asarray(position - self.span * self.images(position))


def open_space() -> Box:
    """Return the box of a scene without periodic directions and without bounds."""
    return Box(np.full(3, -np.inf), np.full(3, np.inf), np.zeros(3, bool))
