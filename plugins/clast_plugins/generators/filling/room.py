"""The room that is filled: a tube or a box with a bottom, open at the top or under a lid."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass
class Room:
    """A tube about the z axis, or a box, on the plane z = 0; lengths in m.

    Attributes
    ----------
    radius : float
        Of the tube; 0 for a box.
    width, depth : float
        Of the box along x and y; 0 for a tube.
    lid : float
        Height of the lid; infinite where there is none.
    """

    radius: float = 0.0
    width: float = 0.0
    depth: float = 0.0
    lid: float = inf

    @property
    def section(self) -> float:
        """Area of the horizontal section in m²."""
        return pi * self.radius**2 if self.radius > 0.0 else self.width * self.depth

    @property
    def numbers(self) -> Floats:
        """Radius, half width, half depth, bottom and lid, (5,)."""
        return np.array([self.radius, 0.5 * self.width, 0.5 * self.depth, 0.0, self.lid])

    @property
    def half_widths(self) -> tuple[float, float]:
        """Half the extent along x and y."""
        return (self.radius, self.radius) if self.radius > 0.0 else (0.5 * self.width, 0.5 * self.depth)

    def walls(self) -> dict[str, dict[str, object]]:
        """Return bottom and sides as the walls of a scene, without their material."""
        bottom: dict[str, object] = {"type": "plane", "point": [0.0, 0.0, 0.0], "normal": [0.0, 0.0, 1.0]}
        if self.radius > 0.0:
            tube = {"type": "cylinder", "point": [0.0, 0.0, 0.0], "axis": [0.0, 0.0, 1.0], "radius": self.radius}
            return {"bottom": bottom, "tube": tube}
        sides = {"left": (-0.5 * self.width, 0), "right": (0.5 * self.width, 0)}
        sides |= {"front": (-0.5 * self.depth, 1), "back": (0.5 * self.depth, 1)}
        return {"bottom": bottom} | {name: _side(*side) for name, side in sides.items()}

    def side_gap(self, x: Floats) -> Floats:
        """Return the distance of (n, 3) points to the nearest side, (n,)."""
        if self.radius > 0.0:
            return np.asarray(self.radius - np.hypot(x[:, 0], x[:, 1]))
        return np.minimum(0.5 * self.width - np.abs(x[:, 0]), 0.5 * self.depth - np.abs(x[:, 1]))

    def gap(self, x: Floats) -> Floats:
        """Return the distance of (n, 3) points to the nearest surface of the room, (n,)."""
        return np.minimum(self.side_gap(x), np.minimum(x[:, 2], self.lid - x[:, 2]))


def _side(place: float, axis: int) -> dict[str, object]:
    """Return the plane across an axis at a place, facing the middle."""
    point, normal = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    point[axis], normal[axis] = place, -1.0 if place > 0.0 else 1.0
    return {"type": "plane", "point": point, "normal": normal}
