"""Walls around a compression: a tube, or planes that close around it."""

from __future__ import annotations

from math import pi, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig

Floats = NDArray[np.float64]
PARALLEL = 1e-6


class SideWalls(NamedTuple):
    """What stands around a compression.

    Attributes
    ----------
    walls : tuple of int
        Their numbers in the order of the scene's walls.
    girth : float
        Length in m of the closed line that they are in a cross-section.
    section : float or None
        Area in m² inside that line; None where the wall does not tell it.
    text : str
        For messages: "walls.tube has".
    outward : (k, 3) float64 or None
        Unit normals of flat walls, away from what is pressed; None of a tube.
    """

    walls: tuple[int, ...]
    girth: float
    section: float | None
    text: str
    outward: Floats | None = None

    def pressed(self, force: Floats, pressing: Floats) -> float:
        """Return what presses on the walls along their normals, summed up, in N.

        Parameters
        ----------
        force : (w, 3) float64
            Forces on all walls of the scene in N.
        pressing : (w,) float64
            How hard contacts press on those that are not flat, in N.
        """
        if self.outward is None:
            return float(pressing[list(self.walls)].sum())
        return float((force[list(self.walls)] * self.outward).sum())

    @property
    def diameter(self) -> float:
        """Diameter in m of a circle of the section's area."""
        return sqrt(4.0 / pi * (self.section or 0.0))


def side_walls(config: SceneConfig, axis: Floats) -> SideWalls | None:
    """Return the walls under ``compression.side``, None where there are none.

    Parameters
    ----------
    config : SceneConfig
        With a ``compression``.
    axis : (3,) float64
        Unit vector along which is pressed.

    Raises
    ------
    ConfigError
        If one of them surrounds nothing, and they are not planes that close around the axis.
    """
    assert config.compression is not None
    names = config.compression.side
    if not names:
        return None
    shapes = [config.walls[name].shape for name in names]
    numbers = tuple(list(config.walls).index(name) for name in names)
    first = shapes[0]
    if len(shapes) == 1 and first.part.girth is not None:
        section = None if first.part.section is None else float(first.part.section(first.params))
        return SideWalls(numbers, float(first.part.girth(first.params)), section, f"walls.{names[0]} has")
    for name, shape in zip(names, shapes, strict=True):
        if len(shapes) == 1 or not shape.part.flat(shape.params):
            alone, together = "of which girth and section are not known", "and only infinite planes surround together"
            text = f"walls.{name} is a {shape.name}, {alone if len(shapes) == 1 else together}; name a wall such as a "
            raise config.problem(("compression", "side"), f"{text}cylinder, or all infinite planes around")
    planes = [_plane(shape) for shape in shapes]
    try:
        area, girth = inside_planes(planes, axis)
    except ValueError as error:
        together = ", ".join(f"walls.{name}" for name in names)
        raise config.problem(("compression", "side"), f"{together}: {error}") from None
    return SideWalls(numbers, girth, area, "the walls around have", -np.array([inward for _, inward in planes]))


def _plane(shape: Chosen) -> tuple[Floats, Floats]:
    """Return a point of a flat wall in m and the unit normal towards the particles."""
    point = shape.part.centre(shape.params)
    return np.array(point), -np.array(shape.part.nearest(shape.part.shape(shape.params), point).normal)


def inside_planes(planes: list[tuple[Floats, Floats]], axis: Floats) -> tuple[float, float]:
    """Return area in m² and circumference in m of the section that planes leave between them.

    Parameters
    ----------
    planes : list of (point, normal)
        A point in m and the unit normal to the inside of each.
    axis : (3,) float64
        Unit vector across the section.

    Raises
    ------
    ValueError
        If a plane is not along the axis, or the planes do not close, or leave nothing between them.

    Examples
    --------
    >>> x, y, z = np.eye(3)
    >>> area, girth = inside_planes([(0 * x, x), (2 * x, -x), (0 * y, y), (3 * y, -y)], z)
    >>> round(area, 9), round(girth, 9)
    (6.0, 10.0)
    """
    from scipy.spatial import ConvexHull, HalfspaceIntersection

    if any(abs(normal @ axis) > PARALLEL for _, normal in planes):
        raise ValueError("planes around must be parallel to the line between the plates; turn them, or the plates")
    across = np.linalg.svd(axis[None])[2][1:]
    normals = np.array([normal for _, normal in planes]) @ across.T
    offsets = np.array([normal @ point for point, normal in planes])
    angles = np.sort(np.arctan2(normals[:, 1], normals[:, 0]))
    if np.diff(angles, append=angles[0] + 2.0 * pi).max() >= pi - PARALLEL:
        raise ValueError("these planes do not close around what is pressed; name all of them")
    middle, reach = _widest_circle(normals, offsets)
    if not reach > 0.0:
        raise ValueError("these planes leave no room between them; their normals point to where the particles are")
    corners = HalfspaceIntersection(np.column_stack([-normals, offsets]), middle).intersections
    hull = ConvexHull(corners)
    return float(hull.volume), float(hull.area)


def _widest_circle(normals: Floats, offsets: Floats) -> tuple[Floats, float]:
    """Return centre and radius in m of the largest circle inside of half-planes; a radius of 0 where there is none."""
    from scipy.optimize import linprog

    scale = float(np.abs(offsets).max()) or 1.0
    rows = np.column_stack([-normals, np.ones(len(normals))])
    found = linprog([0.0, 0.0, -1.0], rows, -offsets / scale, bounds=[(None, None), (None, None), (0.0, None)])
    return (np.zeros(2), 0.0) if found.x is None else (scale * found.x[:2], scale * float(found.x[2]))
