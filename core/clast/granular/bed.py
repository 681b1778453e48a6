"""Bed: where the grains lie, how high the bed is in each frame, and the tube about it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from clast.results.frame import Frame
from clast.results.run import Run
from clast.results.wall_mesh import WallMesh

Floats = NDArray[np.float64]
ROUND = 1e-6
"""Relative difference of the distances from the axis up to which a wall is a tube."""


@dataclass(frozen=True, eq=False)
class Bed:
    """Frame of reference of a bed.

    Attributes
    ----------
    origin : (3,) float64
        A point on the axis, in m: at the lower plate, or at the height 0.
    axis : (3,) float64
        Unit vector from the lower plate to the upper one; z where the scene has no ``compression``.
    plates : (lower, upper) or None
        The two plates; None without a ``compression``.
    tube : float or None
        Radius in m of the tube that holds the bed; None where there is none.
    section : float or None
        Area in m² of the cross-section inside the walls around the bed: the tube, or those under ``compression.side``;
        None where there are none.
    """

    origin: Floats
    axis: Floats
    plates: tuple[WallMesh, WallMesh] | None
    tube: float | None
    section: float | None

    def heights(self, position: Floats) -> Floats:
        """Return the heights of points over the origin in m, (n,)."""
        return np.asarray((position - self.origin) @ self.axis)

    def distances(self, position: Floats) -> Floats:
        """Return the distances of points from the axis in m, (n,)."""
        way = position - self.origin
        return np.asarray(np.linalg.norm(way - np.outer(way @ self.axis, self.axis), axis=1))

    def room(self, low: float, high: float) -> float:
        """Return the volume inside the walls around between two heights in m³; NaN without walls around."""
        return np.nan if self.section is None else self.section * (high - low)

    def gap(self, frame: Frame) -> tuple[float, float]:
        """Return the heights of the lower and the upper plate in m; infinite without plates."""
        if self.plates is None:
            return -np.inf, np.inf
        low, high = (self.heights(plate.placed(frame).mean(axis=0)[None])[0] for plate in self.plates)
        return float(low), float(high)

    def extent(self, frame: Frame, radius: Floats) -> tuple[float, float]:
        """Return the heights between which the bed lies in m: plates, or its own surface where that is nearer."""
        height = self.heights(frame.position.astype(np.float64))
        low, high = self.gap(frame)
        return max(low, float(np.nanmin(height - radius))), min(high, float(np.nanmax(height + radius)))


def bed_of(run: Run) -> Bed:
    """Return the bed of a run that has frames: plates and side as under ``compression``, a tube where a wall is one.

    A wall is a tube where all points of its mesh have one distance from a line along the axis, and all particles lie
    inside that.
    """
    plates = _plates(run)
    axis, origin = np.array([0.0, 0.0, 1.0]), np.zeros(3)
    if plates is not None:
        origin, upper = (plate.points.mean(axis=0) for plate in plates)
        axis = (upper - origin) / np.linalg.norm(upper - origin)
    found = Bed(origin, axis, plates, None, _section(run))
    for wall in run.walls.values():
        tube = _as_tube(found, wall)
        if tube is not None and _holds_all(tube, run):
            return tube
    return found


def _plates(run: Run) -> tuple[WallMesh, WallMesh] | None:
    told = run.config.get("compression") or {}
    lower, upper = run.walls.get(told.get("lower", "")), run.walls.get(told.get("upper", ""))
    return None if lower is None or upper is None else (lower, upper)


def _section(run: Run) -> float | None:
    """Return the section in m² that walls around a compression leave, as the scene has it."""
    told = run.config.get("compression") or {}
    if not told.get("side"):
        return None
    return float(told["area"]) if told.get("area") else 0.25 * np.pi * float(told["diameter"]) ** 2


def _as_tube(bed: Bed, wall: WallMesh) -> Bed | None:
    centre = wall.points.mean(axis=0)
    origin = centre - ((centre - bed.origin) @ bed.axis) * bed.axis
    candidate = Bed(origin, bed.axis, bed.plates, None, None)
    distance = candidate.distances(wall.points)
    height = candidate.heights(wall.points)
    if np.ptp(distance) > ROUND * distance.mean() or np.ptp(height) <= ROUND * distance.mean():
        return None
    radius = float(distance.mean())
    return Bed(origin, bed.axis, bed.plates, radius, np.pi * radius**2)


def _holds_all(tube: Bed, run: Run) -> bool:
    assert tube.tube is not None
    distance = tube.distances(run.frame(0).position.astype(np.float64))
    return not (distance >= tube.tube).any()
