"""Wall meshes: triangles that draw walls, where they are at a frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clast.maths.rotation import Quat, matrix
from clast.results.frame import Frame

UNTURNED: Quat = (1.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class WallMesh:
    """Triangles that draw a wall as it stands at the start.

    Attributes
    ----------
    points : (p, 3) float64
        Corners in m.
    triangles : (t, 3) int64
        Numbers of the corners of each triangle.
    index : int
        Row of this wall in ``Frame.wall_displacement`` and ``Frame.wall_orientation``.
    pivot : (3,) float64 or None
        The point about which it turns, in m at the start; None where it does not.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    index: int
    pivot: NDArray[np.float64] | None = None

    def orientation(self, frame: Frame) -> Quat:
        """Return the unit quaternion (w, x, y, z) that turns it from the start to a frame."""
        if self.pivot is None or frame.wall_orientation is None:
            return UNTURNED
        w, x, y, z = frame.wall_orientation[self.index].tolist()
        return (w, x, y, z)

    def shift(self, frame: Frame) -> NDArray[np.float64]:
        """Return what is added to its points, (3,) in m, once they are turned about the origin."""
        moved = np.asarray(frame.wall_displacement[self.index])
        if self.pivot is None:
            return moved
        return np.asarray(moved + self.pivot - np.array(matrix(self.orientation(frame))) @ self.pivot)

    def placed(self, frame: Frame) -> NDArray[np.float64]:
        """Return its corners at a frame, (p, 3) in m."""
        if self.pivot is None:
            return np.asarray(self.points + self.shift(frame))
        return np.asarray(self.points @ np.array(matrix(self.orientation(frame))).T + self.shift(frame))
