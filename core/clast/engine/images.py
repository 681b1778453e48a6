"""Velocities against nearest images, for what looks at a running scene from outside the compiled loop."""

from __future__ import annotations

import numpy as np

from clast.engine.kernels.layout import GROWTH, PER_SPAN, V, X
from clast.engine.state import Floats, Integers, Particles
from clast.engine.tables import box_of


def velocities_between(particles: Particles, i: Integers, j: Integers) -> Floats:
    """Return the velocities of particles j, or of their nearest images, against particles i, (p, 3) in m/s."""
    place, v, box = particles.pose[:, X : X + 3], particles.twist[:, V : V + 3], box_of(particles)
    straight = v[j] - v[i]
    if box is None:
        return np.asarray(straight)
    return np.asarray(straight - box[GROWTH] * np.rint((place[j] - place[i]) * box[PER_SPAN]))


def growth(particles: Particles) -> float:
    """Return how fast an image can flee from the next at the most, in m/s."""
    box = box_of(particles)
    return 0.0 if box is None else float(np.linalg.norm(box[GROWTH]))
