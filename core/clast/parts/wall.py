"""Wall: a rigid surface that particles touch."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.maths.vec3 import Vec
from clast.parts.params import Params


class Nearest(NamedTuple):
    """The nearest point of a wall, seen from a particle's centre.

    Attributes
    ----------
    distance : float
        From the centre to the surface in m; negative behind it.
    normal : vector
        Unit vector from the centre towards the surface.
    """

    distance: float
    normal: Vec


def never(params: Any) -> bool:
    """Return False, whatever the parameters: what a wall is of which nothing else is known."""
    return False


def once(params: Any) -> int:
    """Return 1: so many contacts a particle has with a wall of which nothing else is known."""
    return 1


def nothing_to_tell(params: Any) -> tuple[str, ...]:
    """Return no sentence, whatever the parameters."""
    return ()


@dataclass(frozen=True)
class Wall:
    """The part a plugin registers with ``registry.wall(name, Wall(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        Shape, as the user writes it under ``walls.NAME``.
    Shape : NamedTuple type
        The numbers the compiled loop needs; arrays of float64 too.
    shape : (params) -> Shape
    nearest : (shape, x) -> Nearest
        For a centre x given in the wall's own frame: its motion is already taken off.
    centre : (params) -> vector
        Point about which the wall's moment is reported, unless it turns: then it is about the pivot of its motion.
    touches : (shape, x, reach, found) -> int, optional
        For surfaces that a sphere can touch in several places. Writes distance and normal, one row each, of every place
        that is nearer to x than ``reach`` and than the surface around it, the nearest first; returns how many there
        are, at most as many as ``found`` has rows.
    slots : (params) -> int, optional
        Most contacts that a particle has with such a wall at a time, 1 to 64.
    mesh : (params, size) -> (points, triangles)
        For pictures: (p, 3) float64 in m and (t, 3) int64; ``size`` in m bounds what is drawn of infinite walls.
    flat : (params) -> bool, optional
        Whether all its normals are one, so that what presses on it is a component of the force on it. On other walls
        forces from opposite sides cancel: there what presses is summed up too.
    girth : (params) -> float, optional
        Length in m of the closed line that a tube's inner face is in its cross-section; None for what is no tube.
    section : (params) -> float, optional
        Area in m² inside that line; with it a compression in the tube is held against it.
    concerns : (params) -> sequence of str, optional
        What the user should know before the run, one sentence each, such as what was left out of a file.
    """

    summary: str
    Params: type[Params]
    Shape: type
    shape: Callable[[Any], Any]
    nearest: Callable[..., Nearest]
    centre: Callable[[Any], Vec]
    mesh: Callable[[Any, float], tuple[NDArray[np.float64], NDArray[np.int64]]]
    flat: Callable[[Any], bool] = never
    girth: Callable[[Any], float] | None = None
    section: Callable[[Any], float] | None = None
    touches: Callable[..., int] | None = None
    slots: Callable[[Any], int] = once
    concerns: Callable[[Any], Sequence[str]] = nothing_to_tell
