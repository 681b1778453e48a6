"""Velocities against nearest images, for what looks at a running scene from outside the compiled loop."""

from __future__ import annotations

import numpy as np

from clast.engine.kernels.layout import GROWTH, PER_SPAN, V, X
from clast.engine.state import Floats, Integers, Particles


def velocities_between(particles: Particles, i: Integers, j: Integers) -> Floats:
    """Return the velocities of particles j, or of their nearest images, against particles i, (p, 3) in m/s."""
    place, v, box = particles.pose[:, X : X + 3], particles.twist[:, V : V + 3], particles.box
    return np.asarray(v[j] - v[i] - box[GROWTH] * np.rint((place[j] - place[i]) * box[PER_SPAN]))
