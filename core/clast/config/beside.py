"""What stands beside keys of Clast: a wall's shape, the stages of its motion, and the neighbour search."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.config.part_beside import Joined, PartBeside
from clast.config.sections import NeighbourSettings, WallSettings
from clast.config.stages import STAGE, Stage, pivot
from clast.maths.vec3 import Vec


@dataclass(frozen=True)
class WallChoice(Joined):
    """A wall: its shape, what it is made of and how it moves: in one stage or several, or not at all.

    ``listed`` tells whether its motion is written as a list, which may be one of a single stage.
    """

    shape: Chosen
    material: str
    stages: tuple[Stage, ...]
    listed: bool = False

    @property
    def motion(self) -> Chosen | None:
        """The motion that it begins with; None where it rests."""
        return self.stages[0].motion if self.stages else None

    @property
    def pivot(self) -> Vec | None:
        """The point in m about which it turns, as it stands at the start; None where it does not turn."""
        return pivot(self.stages)

    @property
    def staged(self) -> bool:
        """Whether its motion ends, or is followed by another, on a condition."""
        return any(stage.until is not None for stage in self.stages)

    @property
    def flat(self) -> bool:
        """Whether what presses on it is a component of the force on it."""
        return bool(self.shape.part.flat(self.shape.params))

    def distance(self, x: NDArray[np.float64]) -> float:
        """Return the distance in m from a point to the surface, as it stands at the start; negative behind it."""
        nearest = self.shape.part.nearest(self.shape.part.shape(self.shape.params), tuple(x.tolist()))
        return float(nearest.distance)

    def plain(self) -> dict[str, Any]:
        """Give the wall as the scene file would have it."""
        stages = [stage.plain() for stage in self.stages]
        motion = {"motion": stages if self.listed else stages[0]} if stages else {}
        return {**self.shape.plain(), "material": self.material, **motion}


@dataclass(frozen=True)
class NeighbourChoice(Joined):
    """How neighbours are found: the search, and how far its lists reach beyond contact."""

    search: Chosen
    skin: float | Literal["auto"]

    def plain(self) -> dict[str, Any]:
        """Give the section as the scene file would have it."""
        return {**self.search.plain(), "skin": self.skin}


def _wall(shape: Chosen, material: str, motion: Stage | tuple[Stage, ...] | None) -> WallChoice:
    stages = (motion,) if isinstance(motion, Stage) else motion or ()
    return WallChoice(shape, material, stages, listed=isinstance(motion, tuple))


WALL = PartBeside("wall", WallSettings, _wall)
NEIGHBOURS = PartBeside("neighbour_search", NeighbourSettings, NeighbourChoice, default="auto")
BESIDE = {each.kind: each for each in (WALL, STAGE, NEIGHBOURS)}
"""By kind of part: the keys of Clast beside it."""
