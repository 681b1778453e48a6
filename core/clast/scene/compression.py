"""Gauge: reads strain, stress and plate forces off two walls, and knows when a scene ends."""

from __future__ import annotations

from functools import cached_property
from math import ceil, pi

import numpy as np
from numpy.typing import NDArray

from clast.config.beside import WallChoice
from clast.config.scene import SceneConfig
from clast.engine.state import Walls
from clast.scene.approach import time_of

Floats = NDArray[np.float64]
MOST_STEPS = 10**12


class Gauge:
    """Strain and stress of a compression between an upper and a lower wall.

    Displacement is the approach of the two walls along the line from the lower wall's reference point to the upper
    one's; strain is displacement over ``compression.height``; stress is the force on the upper wall over the area of
    a circle of ``compression.diameter``.
    """

    def __init__(self, config: SceneConfig) -> None:
        self.config = config
        self.names = list(config.walls)
        self.axis: Floats | None = None
        if config.compression is not None:
            self.upper = self.names.index(config.compression.upper)
            self.lower = self.names.index(config.compression.lower)
            self.height = config.compression.height
            self.area = 0.25 * pi * config.compression.diameter**2
            self.axis = self._axis()

    def _axis(self) -> Floats:
        upper, lower = (self._centre(k) for k in (self.upper, self.lower))
        line = upper - lower
        length = np.linalg.norm(line)
        if length == 0.0:
            raise self.config.problem(
                ("compression",),
                "the upper and the lower wall are in the same place, so there is no axis to press along; move one of "
                "them",
            )
        return np.asarray(line / length)

    def _centre(self, k: int) -> Floats:
        wall = self._wall(k).shape
        return np.asarray(wall.part.centre(wall.params), float)

    def displacement(self, walls: Walls) -> float:
        """Return the approach of the plates in m."""
        assert self.axis is not None
        return float((walls.displacement[self.lower] - walls.displacement[self.upper]) @ self.axis)

    def strain(self, walls: Walls) -> float:
        """Return displacement over height; 0 without a compression."""
        return 0.0 if self.axis is None else self.displacement(walls) / self.height

    def forces(self, force: Floats) -> tuple[float, float]:
        """Return what pushes the plates apart, upper and lower, in N, from the (w, 3) forces on the walls."""
        assert self.axis is not None
        return float(force[self.upper] @ self.axis), float(-force[self.lower] @ self.axis)

    def last_step(self, dt: float, step: int = 0, time: float = 0.0) -> int:
        """Return the step at which the scene ends, with steps of ``dt`` from a step and its time on.

        Raises
        ------
        ConfigError
            If the plates never reach the strain, or only after more steps than can be counted.
        """
        end = self.config.time.end
        steps = float(end.steps) if end.steps is not None else step + (self._end_time() - time) / dt
        if not steps <= MOST_STEPS:
            text = f"{steps:.3g} steps of {dt:.3g} s, more than {MOST_STEPS:.0e}; end earlier, or raise time.step"
            raise self.config.problem(("time", "end"), text)
        return max(1, ceil(steps - 1e-9))

    def _end_time(self) -> float:
        end = self.config.time.end
        if end.time is not None:
            return end.time
        return self._time_of_strain

    @cached_property
    def _time_of_strain(self) -> float:
        """When the plates have approached by the strain at the end, in s."""
        strain = self.config.time.end.strain
        assert strain is not None
        self._refuse_answers()
        found = time_of(self._approach_rate, strain * self.height)
        if found.time is None:
            most = f" by more than the strain {found.distance / self.height:.4g}" if found.distance > 0.0 else ""
            raise self.config.problem(
                ("time", "end", "strain"),
                f"the plates do not approach each other{most}; give walls.{self.names[self.upper]}.motion a velocity "
                f"towards walls.{self.names[self.lower]}",
            )
        return found.time

    def _refuse_answers(self) -> None:
        for k in (self.upper, self.lower):
            motion = self._wall(k).motion
            if motion is not None and motion.part.velocity is None:
                raise self.config.problem(
                    ("time", "end", "strain"),
                    f"walls.{self.names[k]} moves by {motion.name}, in answer to what presses on it, so when it "
                    "reaches a strain cannot be known beforehand; give time.end.time instead",
                )

    def _wall(self, k: int) -> WallChoice:
        return list(self.config.walls.values())[k]

    def _approach_rate(self, time: float) -> float:
        assert self.axis is not None
        return float((self._velocity(self.lower, time) - self._velocity(self.upper, time)) @ self.axis)

    def _velocity(self, k: int, time: float) -> Floats:
        motion = self._wall(k).motion
        if motion is None:
            return np.zeros(3)
        return np.asarray(motion.part.velocity(motion.part.course(motion.params), time))
