"""Body force: what pulls everywhere, as an acceleration or as a load on each particle."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.errors import PluginError
from clast.maths.vec3 import Vec
from clast.parts.params import Params

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class BodyForce:
    """The part a plugin registers with ``registry.body_force(name, BodyForce(...))``.

    It is known as an acceleration, the same for all particles in one place, or as a load on each: it has either
    ``acceleration`` or ``load``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes in the list ``body_forces``.
    Numbers : NamedTuple type
        The numbers the compiled loop needs.
    numbers : (params, mass_scaling) -> Numbers
        ``mass_scaling`` is the factor on all masses of the scene. Forces stay what they are without it, so an
        acceleration is divided by it, and a load is not.
    acceleration : (numbers, x, v, time) -> vector, optional
        Acceleration of a particle in m/s².
    load : (numbers, x, v, w, radius, time) -> (vector, vector), optional
        Force in N and torque in N m on a particle that moves with v and spins with w.
    damping : (numbers, radius, velocity) -> (array, array), optional
        How much more force a load takes for more velocity, in N s/m, and how much more torque for more spin, in N m s:
        (n,) each, from radii (n,) and velocities (n, 3); at least the largest for any direction. It enters the stable
        step.

    Raises
    ------
    PluginError
        If it has neither or both of acceleration and load.
    """

    summary: str
    Params: type[Params]
    Numbers: type
    numbers: Callable[[Any, float], Any]
    acceleration: Callable[..., Vec] | None = None
    load: Callable[..., tuple[Vec, Vec]] | None = None
    damping: Callable[[Any, Floats, Floats], tuple[Floats, Floats]] | None = None

    def __post_init__(self) -> None:
        if (self.acceleration is None) == (self.load is None):
            raise PluginError(f"body force {self.summary!r} needs either 'acceleration' or 'load'")
