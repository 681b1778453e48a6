"""Random numbers of a fill, from raw bits: these stay the same over versions of numpy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from clast_plugins.generators.packing.room import uniforms

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def random_order(stream: np.random.Philox, count: int) -> Ints:
    """Return the numbers from 0 to ``count`` − 1 in random order."""
    return np.argsort(np.asarray(stream.random_raw(count), np.uint64), kind="stable")


def random_turns(stream: np.random.Philox, count: int) -> Floats:
    """Return unit quaternions (count, 4), uniform over all rotations.

    Source: K. Shoemake, "Uniform random rotations", Graphics Gems III (1992) 124-132.

    >>> q = random_turns(np.random.Philox(1), 5)
    >>> bool(np.allclose((q**2).sum(axis=1), 1.0))
    True
    """
    u = 0.5 * (uniforms(stream, count) + 1.0)
    a, b = np.sqrt(1.0 - u[:, 0]), np.sqrt(u[:, 0])
    s, t = 2.0 * np.pi * u[:, 1], 2.0 * np.pi * u[:, 2]
    return np.column_stack([b * np.cos(t), a * np.sin(s), a * np.cos(s), b * np.sin(t)])
