"""Wall: a rigid surface that particles touch; motion: how it moves; body force: what pulls everywhere."""

from __future__ import annotations

from collections.abc import Callable
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
        The numbers the compiled loop needs.
    shape : (params) -> Shape
    nearest : (shape, x) -> Nearest
        For a centre x given in the wall's own frame (its displacement already subtracted).
    centre : (params) -> vector
        Point about which the wall's moment is reported.
    mesh : (params, size) -> (points, triangles)
        For pictures: (p, 3) float64 in m and (t, 3) int64; ``size`` in m bounds what is drawn of infinite walls.
    """

    summary: str
    Params: type[Params]
    Shape: type
    shape: Callable[[Any], Any]
    nearest: Callable[..., Nearest]
    centre: Callable[[Any], Vec]
    mesh: Callable[[Any, float], tuple[NDArray[np.float64], NDArray[np.int64]]]


@dataclass(frozen=True)
class Motion:
    """The part a plugin registers with ``registry.motion(name, Motion(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``walls.NAME.motion``.
    Course : NamedTuple type
        The numbers the compiled loop needs.
    course : (params) -> Course
    velocity : (course, time) -> vector
        Velocity of the wall in m/s.
    """

    summary: str
    Params: type[Params]
    Course: type
    course: Callable[[Any], Any]
    velocity: Callable[..., Vec]


@dataclass(frozen=True)
class BodyForce:
    """The part a plugin registers with ``registry.body_force(name, BodyForce(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes in the list ``body_forces``.
    Numbers : NamedTuple type
        The numbers the compiled loop needs.
    numbers : (params, mass_scaling) -> Numbers
    acceleration : (numbers, x, v, time) -> vector
        Acceleration of a particle in m/s².
    """

    summary: str
    Params: type[Params]
    Numbers: type
    numbers: Callable[[Any, float], Any]
    acceleration: Callable[..., Vec]
