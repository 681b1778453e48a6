"""The frames of walls, asked from Python: as ``kernels.wall_frames``, for many places at a time."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.engine.kernels.layout import ARM, WALL_Q, WALL_W
from clast.engine.state import Floats, Particles, Walls
from clast.maths.rotation import matrix


class WallFrames(NamedTuple):
    """Where walls are: ``pose`` and ``centre`` as in :class:`clast.engine.state.Walls`."""

    pose: Floats
    centre: Floats

    def turned_by(self, w: int) -> Floats:
        """Return the matrix (3, 3) that takes directions in the frame of a wall into space."""
        if self.pose.shape[1] == 3:
            return np.eye(3)
        w_, x, y, z = self.pose[w, WALL_Q:].tolist()
        return np.array(matrix((w_, x, y, z)))

    def seen(self, w: int, x: Floats) -> Floats:
        """Return places (n, 3) in the frame of a wall."""
        if self.pose.shape[1] == 3:
            return np.asarray(x - self.pose[w])
        return np.asarray((x - self.pose[w, :3] - self.centre[w]) @ self.turned_by(w) + self.centre[w])

    def in_space(self, w: int, directions: Floats) -> Floats:
        """Return directions (n, 3) that are given in the frame of a wall."""
        return directions if self.pose.shape[1] == 3 else directions @ self.turned_by(w).T


def at_start(count: int) -> WallFrames:
    """Return the frames of some walls at the start."""
    return WallFrames(np.zeros((count, 3)), np.zeros((count, 3)))


def now(walls: Walls) -> WallFrames:
    """Return the frames of the walls of a running scene."""
    return WallFrames(walls.pose, walls.centre)


def surface_velocities(walls: Walls, w: NDArray[np.integer], x: Floats) -> Floats:
    """Return the velocities in m/s of walls w (n,) at places (n, 3)."""
    if walls.twist.shape[1] == 3:
        return np.asarray(walls.velocity[w])
    arms = x - walls.displacement[w] - walls.centre[w]
    return np.asarray(walls.velocity[w] + np.cross(walls.twist[w, WALL_W:], arms))


def fastest_surface(walls: Walls) -> float:
    """Return the highest speed in m/s at which a wall can meet a particle; 0 without walls."""
    speed = np.linalg.norm(walls.velocity, axis=1)
    if walls.twist.shape[1] > 3:
        speed += np.linalg.norm(walls.twist[:, WALL_W:], axis=1) * walls.reference[:, ARM]
    return float(speed.max(initial=0.0))


def arms(walls: Walls, particles: Particles, reach: Floats) -> Floats:
    """Return how far from the centre of each wall (w,) particles may touch it, in m; they come ``reach`` (n,) far."""
    here = particles.present != 0
    place, reach = particles.pose[here, :3], reach[here]
    centres = walls.displacement + walls.centre
    return np.array([(np.linalg.norm(place - centre, axis=1) + reach).max(initial=0.0) for centre in centres])
