"""Gauge: reads strain, stress and plate forces off two walls, and knows when a scene ends."""

from __future__ import annotations

from functools import cached_property
from math import ceil
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from clast.config.beside import WallChoice
from clast.config.scene import SceneConfig
from clast.engine.state import Walls
from clast.scene.approach import time_of
from clast.scene.scene import is_logarithmic, strain_rates
from clast.scene.side_walls import SideWalls, side_walls
from clast.scene.turning import spins

Floats = NDArray[np.float64]
MOST_STEPS = 10**12
TILTED = 1e-6
"""Sine of the angle between axis and line up to which a plate counts as turning about that."""

MOST_OFF = 0.01
"""Share by which height and diameter, or area, of a compression with a side may differ from those of the walls."""


class SideReading(NamedTuple):
    """What the walls around a compression carry, together.

    Attributes
    ----------
    stress_lower_Pa : float
        Force on the lower wall over the area of the section, in Pa.
    stress_side_Pa : float
        What presses on the walls around along their normals, over their face between the plates as they stand, in Pa.
    lateral_pressure_coefficient : float
        Stress on the walls around over the mean of the stresses on the plates; 0 where nothing presses on them.
    wall_friction_share : float
        Force on the walls around in the direction in which the upper wall presses, over the force on the upper wall; 0
        where nothing presses on that. At rest and without weight the rest is carried by the lower wall.
    """

    stress_lower_Pa: float
    stress_side_Pa: float
    lateral_pressure_coefficient: float
    wall_friction_share: float


class Gauge:
    """Strain and stress of a compression between an upper and a lower wall, and those on the walls around.

    Displacement is the approach of the two walls along the line from the lower wall's reference point to the upper
    one's; strain is displacement over ``compression.height``; stress is the force on the upper wall over
    ``compression.area``, or that of a circle of ``compression.diameter``. What is read off the walls around is told by
    :class:`SideReading`.
    """

    def __init__(self, config: SceneConfig) -> None:
        self.config = config
        self.names = list(config.walls)
        self.axis: Floats | None = None
        if config.compression is not None:
            self.upper = self.names.index(config.compression.upper)
            self.lower = self.names.index(config.compression.lower)
            self.height = config.compression.height
            self.area = config.compression.section
            line = self._line()
            self.distance = float(np.linalg.norm(line))
            self.axis = line / self.distance
            self._refuse_tilting(self.axis)
            self.side = self._side(self.axis)

    def _line(self) -> Floats:
        """Return the way from the lower wall's reference point to the upper one's at the start, in m."""
        line = self._centre(self.upper) - self._centre(self.lower)
        if not line.any():
            raise self.config.problem(
                ("compression",),
                "the upper and the lower wall are in the same place, so there is no axis to press along; move one of "
                "them",
            )
        return line

    def _refuse_tilting(self, axis: Floats) -> None:
        """Refuse plates that turn about anything but the line between them, so that they tilt."""
        plates = (self.names[self.upper], self.names[self.lower])
        for path, motion in self.config.motions:
            turned = spins(motion)
            if path[1] in plates and np.abs(np.cross(turned, axis)).max() > TILTED * np.abs(turned).max():
                raise self.config.problem(
                    path,
                    "a plate of the compression may turn about the line between the plates only, as strain is read off "
                    "their distance; turn it about that, or leave the compression out",
                )

    def _side(self, axis: Floats) -> SideWalls | None:
        """Return the walls around, after the height between the plates and the section were held against them."""
        found = side_walls(self.config, axis)
        if found is None:
            return None
        upper, lower = self.names[self.upper], self.names[self.lower]
        apart = abs(self._wall(self.lower).distance(self._centre(self.upper)))
        if abs(self.height - apart) > MOST_OFF * self.height:
            text = (
                f"{1e3 * self.height:.5g} mm, but walls.{upper} stands {1e3 * apart:.5g} mm from walls.{lower}; strain "
                "needs this distance: give it here, or move a wall"
            )
            raise self.config.problem(("compression", "height"), text)
        self._refuse_another_section(found)
        return found

    def _refuse_another_section(self, side: SideWalls) -> None:
        pressed = self.config.compression
        assert pressed is not None
        if side.section is None:
            return
        share = side.section / self.area
        if abs((share if pressed.diameter is None else share**0.5) - 1.0) <= MOST_OFF:
            return
        if pressed.diameter is not None:
            key, given = "diameter", f"{1e3 * pressed.diameter:.5g} mm"
            true = f"the section of a circle of {1e3 * side.diameter:.5g} mm"
        else:
            key, given, true = "area", f"{1e6 * self.area:.5g} mm2", f"a section of {1e6 * side.section:.5g} mm2"
        raise self.config.problem(
            ("compression", key),
            f"{given}, but {side.text} {true}; stress needs this one: give it here, or change the walls",
        )

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

    def side_reading(self, walls: Walls, force: Floats, pressing: Floats) -> SideReading | None:
        """Return what the walls around carry; None without any.

        Parameters
        ----------
        walls : Walls
        force : (w, 3) float64
            Forces on the walls in N.
        pressing : (w,) float64
            How hard contacts press on walls that are not flat along their normals, in N.
        """
        if self.axis is None or self.side is None:
            return None
        upper, lower = self.forces(force)
        face = self.side.girth * (self.distance - self.displacement(walls))
        radial = self.side.pressed(force, pressing) / face if face > 0.0 else 0.0
        axial = 0.5 * (upper + lower) / self.area
        carried = -float(force[list(self.side.walls)].sum(axis=0) @ self.axis)
        return SideReading(
            stress_lower_Pa=lower / self.area,
            stress_side_Pa=radial,
            lateral_pressure_coefficient=radial / axial if axial > 0.0 else 0.0,
            wall_friction_share=carried / upper if upper > 0.0 else 0.0,
        )

    def last_step(self, dt: float, step: int = 0, time: float = 0.0) -> int:
        """Return the step at which the scene ends, with steps of ``dt`` from a step and its time on.

        Raises
        ------
        ConfigError
            If plates or box never reach the strain, or only after more steps than can be counted; if a wall does not
            know how to move so long.
        """
        end = self.config.time.end
        steps = float(end.steps) if end.steps is not None else step + (self._end_time() - time) / dt
        self._refuse_longer(time + (steps - step - 1.0) * dt)
        if not steps <= MOST_STEPS:
            text = f"{steps:.3g} steps of {dt:.3g} s, more than {MOST_STEPS:.0e}; end earlier, or raise time.step"
            raise self.config.problem(("time", "end"), text)
        return max(1, ceil(steps - 1e-9))

    def _refuse_longer(self, end: float) -> None:
        for path, motion in self.config.motions:
            if motion.part.lasts is None:
                continue
            last = motion.part.lasts(motion.part.course(motion.params))
            if end > last:
                raise self.config.problem(
                    path,
                    f"tells how the wall moves for {last:.5g} s only, and the scene lasts {end:.5g} s or more; end it "
                    "earlier, or let the motion go on",
                )

    def _end_time(self) -> float:
        end = self.config.time.end
        if end.time is not None:
            return end.time
        return self._time_of_strain if self.axis is not None else self._time_of_box_strain()

    def _time_of_box_strain(self) -> float:
        """Return when the side of a stretched box that is strained fastest has the strain at the end, in s."""
        rates, strain = strain_rates(self.config), self.config.time.end.strain
        assert strain is not None
        if not rates.any():
            raise self.config.problem(
                ("time", "end", "strain"),
                "the box is not stretched, as all of boundaries.domain.strain_rate are 0; give one that is not",
            )
        time = strain / float(np.abs(rates).max())
        if not is_logarithmic(self.config) and -time * float(rates.min()) >= 1.0:
            raise self.config.problem(
                ("time", "end", "strain"),
                f"a side that is pressed to the engineering strain {strain:g} has no length left; end below 1",
            )
        return time

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
            if self._wall(k).staged:
                raise self.config.problem(
                    ("time", "end", "strain"),
                    f"walls.{self.names[k]} moves until a condition holds, so when it reaches a strain cannot be known "
                    "beforehand; give time.end.time, and a strain under 'stop'",
                )
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
