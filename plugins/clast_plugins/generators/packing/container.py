"""The room that the centres of a packing may take: a ball, perhaps cut by two planes."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


class Container(NamedTuple):
    """A ball about the origin between two planes at ``z = ±half_height``.

    It holds *centres*: for whole spheres inside a body it is the body shrunk by one sphere radius.

    >>> around(radius=2.5, half_height=2.0)
    Container(radius=2.0, half_height=1.5)
    """

    radius: float
    half_height: float = math.inf


def around(radius: float, half_height: float = math.inf) -> Container:
    """Return the container of the centres of spheres of diameter 1 that lie wholly in a body of this size."""
    return Container(radius - 0.5, half_height - 0.5)


def confine(position: Floats, container: Container) -> Floats:
    """Return centres moved into the container: onto the planes first, then radially onto the ball.

    Parameters
    ----------
    position : (n, 3) float64
        Centres, in the container's unit of length.

    Examples
    --------
    >>> confine(np.array([[0.0, 0.0, 9.0], [3.0, 0.0, 0.0]]), Container(2.0, 1.0))
    array([[0., 0., 1.],
           [2., 0., 0.]])
    """
    moved = position.copy()
    np.clip(moved[:, 2], -container.half_height, container.half_height, out=moved[:, 2])
    distance = np.sqrt(moved[:, 0] ** 2 + moved[:, 1] ** 2 + moved[:, 2] ** 2)
    outside = distance > container.radius
    moved[outside] *= (container.radius / distance[outside])[:, None]
    return moved


def uniforms(stream: np.random.Philox, count: int) -> Floats:
    """Return ``count`` rows of three numbers, uniform in [-1, 1).

    Made from raw bits: numpy promises to keep these over its versions, but not its distributions.

    >>> bool(np.all(np.abs(uniforms(np.random.Philox(1), 100)) <= 1.0))
    True
    """
    bits = np.asarray(stream.random_raw(3 * count), np.uint64)
    return np.asarray((bits >> np.uint64(11)) * 2.0**-52 - 1.0, np.float64).reshape(count, 3)


def random_centres(stream: np.random.Philox, count: int, container: Container) -> Floats:
    """Return ``count`` points, uniform in the container.

    Returns
    -------
    (count, 3) float64
    """
    room = np.array([1.0, 1.0, min(1.0, container.half_height / container.radius if container.radius else 1.0)])
    kept = np.empty((0, 3))
    while len(kept) < count:
        trial = uniforms(stream, 2 * count) * room
        inside = trial[:, 0] ** 2 + trial[:, 1] ** 2 + trial[:, 2] ** 2 <= 1.0
        kept = np.vstack([kept, trial[inside] * container.radius])
    return kept[:count]
