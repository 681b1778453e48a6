"""A body inside a closed surface of triangles as a room."""

from __future__ import annotations

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from clast.errors import ConfigError
from clast_plugins.generators.packing.room import Floats, random_points, uniforms
from clast_plugins.walls.surface.inside import Surface, all_moved_in, depths, is_inside, surface_of
from clast_plugins.walls.surface.tree import planted

MERGED = 1e-6
"""Distance up to which corners are one, in the length of the body: files hold single precision."""
LOOKED, TIMES = 4000, 40
"""Points that are looked at for the deepest, and how often its surroundings are, ever nearer."""
STOCK = 20_000
"""Points kept for centres that have no way to a margin."""


class ClosedSurface:
    """What lies inside a closed surface about the origin.

    Parameters
    ----------
    triangles : (t, 3, 3) float64
        Corners, turning one way all over; see :func:`closed`.
    """

    def __init__(self, triangles: Floats) -> None:
        self.triangles = triangles

    @cached_property
    def _surface(self) -> Surface:
        return surface_of(self.triangles, planted(self.triangles))

    @cached_property
    def _half_edges(self) -> Floats:
        return np.asarray(np.abs(self.triangles).max(axis=(0, 1)))

    @property
    def volume(self) -> float:
        """Volume, by the theorem of Gauss."""
        return float(_sixfold(self.triangles).sum() / 6.0)

    @property
    def surface(self) -> float:
        """Sum of the areas of the triangles."""
        a, b, c = self.triangles.transpose(1, 0, 2)
        return float(0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())

    @cached_property
    def inradius(self) -> float:
        """Radius of the largest sphere that has room: the depth of many points, ever nearer to the deepest of them."""
        stream, step = np.random.Philox(1), self._half_edges / 10.0
        tried = self._half_edges * uniforms(stream, LOOKED)
        best, deepest = tried[0], -np.inf
        for _ in range(TIMES):
            found = depths(self._surface, tried)
            k = int(np.argmax(found))
            if found[k] > deepest:
                best, deepest = tried[k], float(found[k])
            tried = best + step * uniforms(stream, LOOKED // 20)
            step = 0.75 * step
        return deepest

    def per(self, length: float) -> ClosedSurface:
        """Return the room in another unit of length."""
        return ClosedSurface(self.triangles / length)

    def random(self, stream: np.random.Philox, count: int, margin: float) -> Floats:
        """Return ``count`` points (count, 3), uniform among those at least ``margin`` from the surface."""
        return random_points(stream, count, self._half_edges, lambda x: depths(self._surface, x) >= margin)

    @cached_property
    def _stock(self) -> tuple[Floats, Floats]:
        points = self.random(np.random.Philox(2), STOCK, 0.0)
        return points, depths(self._surface, points)

    def confine(self, position: Floats, margin: Floats) -> Floats:
        """Return centres (n, 3) moved to their margins (n,): straight away from the nearest point of the surface.

        What comes too near to another face is moved on. Where that does not end, as in a gap that is too narrow, the
        nearest of many points is taken that have the margin.
        """
        moved, kept = all_moved_in(self._surface, position, margin)
        for k in np.flatnonzero(~kept):
            points, deep = self._stock
            roomy = points[deep >= min(margin[k], float(deep.max()))]
            moved[k] = roomy[np.argmin(((roomy - position[k]) ** 2).sum(axis=1))]
        return moved


def closed(triangles: Floats, where: str) -> Floats:
    """Return triangles (t, 3, 3) of a closed surface about the middle of its volume, turned so that it is positive.

    Raises
    ------
    ConfigError
        The surface is not closed, its triangles do not all turn one way, or it is that of several bodies.
    """
    corners = _numbered(triangles)
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    _, edge, counts = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    if (counts != 2).any():
        raise ConfigError(
            f"{where}is not closed: {int((counts != 2).sum())} of {len(counts)} edges do not belong to two triangles; "
            "repair it, where it was made or with a program such as MeshLab"
        )
    if len(np.unique(edges, axis=0)) != len(edges):
        raise ConfigError(f"{where}has triangles that do not all turn the same way; let a program make them agree")
    sixfold = _sixfold(triangles)
    if sixfold.sum() < 0.0:
        triangles, sixfold = triangles[:, ::-1], -sixfold
    middle = (sixfold[:, None] * triangles.sum(axis=1)).sum(axis=0) / (4.0 * sixfold.sum())
    about = np.asarray(triangles - middle)
    _refuse_several(about, _pieces(edge.ravel(), len(about)), where)
    return about


def _pieces(edge: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """Return the piece of a closed surface that each triangle is of, (t,): those of one piece hang together by edges.

    ``edge`` (3 t,) is the number of the first edge of all triangles, then of the second, then of the third.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    beside = (np.argsort(edge, kind="stable") % count).reshape(-1, 2)
    links = coo_array((np.ones(len(beside), np.int8), (beside[:, 0], beside[:, 1])), shape=(count, count))
    return np.asarray(connected_components(links, directed=False)[1], np.int64)


def _refuse_several(triangles: Floats, piece: NDArray[np.int64], where: str) -> None:
    """Refuse a surface of several pieces, but for a body with hollows: pieces inside it that turn the other way.

    Raises
    ------
    ConfigError
    """
    if piece.max() == 0:
        return
    volumes = np.bincount(piece, weights=_sixfold(triangles))
    body = triangles[piece == np.argmax(volumes)]
    around = surface_of(body, planted(body))
    first = triangles[np.unique(piece, return_index=True)[1], 0].tolist()
    hollow = [v < 0.0 and is_inside(around, (x, y, z)) for v, (x, y, z) in zip(volumes, first, strict=True)]
    if hollow.count(False) > 1:
        raise ConfigError(
            f"{where}is that of {hollow.count(False)} separate bodies, and a grain is one: give each a generator of "
            "its own with a surface of its own, or turn what shall be a hollow in another body inside out"
        )


def _numbered(triangles: Floats) -> NDArray[np.int64]:
    """Return the numbers of the corners, (t, 3): those that are one have one."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    points = triangles.reshape(-1, 3)
    near = cKDTree(points).query_pairs(MERGED * float(np.ptp(points, axis=0).max()), output_type="ndarray")
    links = coo_array((np.ones(len(near), np.int8), (near[:, 0], near[:, 1])), shape=(len(points),) * 2)
    return np.asarray(connected_components(links)[1], np.int64).reshape(-1, 3)


def _sixfold(triangles: Floats) -> Floats:
    """Return six times the volume between the origin and each triangle."""
    a, b, c = triangles.transpose(1, 0, 2)
    return np.asarray((a * np.cross(b, c)).sum(axis=1))
