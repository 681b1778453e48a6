"""Room: a container that a generator fills, told by points in it, so that walls can be held against it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class FilledRoom:
    """Where particles will lie, and where something should stand that keeps them there.

    Attributes
    ----------
    text : str
        What it is, for messages: "a tube 14 mm wide, 8.4 mm high".
    faces : mapping
        Points (p, 3) in m spread over each face that needs a wall, by the name of the face.
    inside : (q, 3) float64
        Points in m spread over the room.
    depth : (q,) float64
        Distance in m of each point inside to the nearest face, open ones included.
    """

    text: str
    faces: Mapping[str, Floats]
    inside: Floats
    depth: Floats
