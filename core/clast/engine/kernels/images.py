"""Ways and velocities between two particles, as they are to the nearest image of the second in a periodic box.

Particles go on where they leave the box, so nothing jumps; only what lies between two of them is brought to the
nearest image. In scenes without a periodic direction none of this is compiled.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from clast.engine.compiler import inlined, written_out
from clast.engine.state import Floats, Particles
from clast.maths.vec3 import Vec, add, sub

from .lanes import row
from .layout import GROWTH, PER_SPAN, SPAN, V, X
from .slots import PERIODIC, STRETCHES


@written_out
def box_of(particles: Any) -> Any:
    """Return the table of the box, which only particles that repeat themselves have."""
    return particles.box


@inlined
def nearest(box: Floats, d: Vec) -> Vec:
    """Return the way to the nearest image of what lies in the direction of ``d``.

    Half-way ties go to the even image: the way from j to i is always that from i to j turned round.
    """
    return (
        d[0] - box[SPAN, 0] * np.rint(d[0] * box[PER_SPAN, 0]),
        d[1] - box[SPAN, 1] * np.rint(d[1] * box[PER_SPAN, 1]),
        d[2] - box[SPAN, 2] * np.rint(d[2] * box[PER_SPAN, 2]),
    )


@inlined
def way_between(particles: Particles, i: int, j: int) -> Vec:
    """Return the way from particle i to particle j, or to its nearest image, in m."""
    d = sub(row(particles.pose, j, X), row(particles.pose, i, X))
    if PERIODIC:
        d = nearest(box_of(particles), d)
    return d


@inlined
def image_velocity(particles: Particles, i: int, j: int) -> Vec:
    """Return how fast the image of particle j that is nearest to i flees from j itself, as the box is stretched."""
    d, box = sub(row(particles.pose, j, X), row(particles.pose, i, X)), box_of(particles)
    return (
        -box[GROWTH, 0] * np.rint(d[0] * box[PER_SPAN, 0]),
        -box[GROWTH, 1] * np.rint(d[1] * box[PER_SPAN, 1]),
        -box[GROWTH, 2] * np.rint(d[2] * box[PER_SPAN, 2]),
    )


@inlined
def velocity_between(particles: Particles, velocities: Floats, i: int, j: int) -> Vec:
    """Return the velocity of particle j, or of its nearest image, against particle i, in m/s."""
    v = sub(row(velocities, j, V), row(velocities, i, V))
    if STRETCHES:
        v = add(v, image_velocity(particles, i, j))
    return v
