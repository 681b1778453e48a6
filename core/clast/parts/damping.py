"""Damping: what brakes every particle by itself, beside the dashpots of contacts and bonds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from clast.maths.vec3 import Vec
from clast.parts.params import Params


def whole(params: Any) -> float:
    """Return 1, whatever the parameters: the share of the stable step that a damping leaves which costs nothing."""
    return 1.0


@dataclass(frozen=True)
class Damping:
    """The part a plugin registers with ``registry.damping(name, Damping(...))``.

    Attributes
    ----------
    summary : str
        One line for ``clast plugins``.
    Params : type
        What the user writes under ``damping``.
    Numbers : NamedTuple type
        The numbers the compiled loop needs.
    numbers : (params) -> Numbers
    braking : (numbers, acceleration, velocity) -> vector
        What the damping adds to the acceleration that all forces give a particle, in m/s², at its velocity in m/s; and
        to its angular acceleration in rad/s², at its spin in rad/s. Must not add energy: braking · velocity ≤ 0.
    step_share : (params) -> float, optional
        Share of the stable step that the damping leaves, whatever the scene and the integrator.
    """

    summary: str
    Params: type[Params]
    Numbers: type
    numbers: Callable[[Any], Any]
    braking: Callable[..., Vec]
    step_share: Callable[[Any], float] = whole
