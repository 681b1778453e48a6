"""Stages: lets the next motion of a wall begin where the condition of the present one holds."""

from __future__ import annotations

from clast.config.scene import SceneConfig
from clast.parts.stop import Curves
from clast.scene.wall_rows import WallRows, wall_rows
from clast.simulation import Simulation


class Stages:
    """The walls of a scene whose motions are over on a condition. Which stage each is in lies with the walls.

    Parameters
    ----------
    config : SceneConfig
    """

    def __init__(self, config: SceneConfig) -> None:
        self.walls = [(w, wall.stages) for w, wall in enumerate(config.walls.values()) if wall.staged]
        self.rows: WallRows | None = None

    def look(self, simulation: Simulation, curves: Curves) -> None:
        """Ask the condition of every wall's stage, with the samples since it began; go on where it is reached."""
        for w, stages in self.walls:
            number, first = simulation.world.walls.stage[w].tolist()
            until = stages[number].until if number < len(stages) else None
            since = {name: values[first:] for name, values in curves.items()}
            if until is not None and until.part.reached(until.params, since) is not None:
                self._begin(simulation, w, number + 1, first + len(since["time_s"]) - 1)

    def _begin(self, simulation: Simulation, w: int, number: int, sample: int) -> None:
        if self.rows is None:
            self.rows = wall_rows(simulation.scene, simulation.plan)
        walls, course = simulation.world.walls, self.rows.courses[w][number]
        walls.motion_kind[w] = course.kind
        walls.course[w] = 0.0
        walls.course[w, : len(course.row)] = course.row
        walls.begun[w] = simulation.time
        walls.stage[w] = number, sample
