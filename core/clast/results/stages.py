"""Stages: lets the next motion of a wall begin where the condition of the present one holds."""

from __future__ import annotations

from clast.config.scene import SceneConfig
from clast.errors import RunError
from clast.parts.stop import Curves
from clast.scene.wall_rows import WallRows, wall_rows
from clast.simulation import Simulation
from clast.soundness.sunken import sunken


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
        before, *later = dict(self.walls)[w][number - 1 : number + 1]
        if later and later[0].motion.part.inverse_mass is not None and before.motion.part.inverse_mass is None:
            self._refuse_sunken(simulation, w, number)
        if self.rows is None:
            self.rows = wall_rows(simulation.scene, simulation.plan)
        walls, course = simulation.world.walls, self.rows.courses[w][number]
        walls.motion_kind[w] = course.kind
        walls.course[w] = 0.0
        walls.course[w, : len(course.row)] = course.row
        walls.begun[w] = simulation.time
        walls.stage[w] = number, sample

    def _refuse_sunken(self, simulation: Simulation, w: int, number: int) -> None:
        """Refuse to let forces move a wall that they would shoot out of particles it was driven into."""
        found, config = sunken(simulation.scene, simulation.world, w), simulation.config
        if found is not None:
            where = ("walls", list(config.walls)[w])
            text = (
                f"as its motion {number + 1} begins, at t = {simulation.time:.4g} s, it stands {found}: forces would "
                "shoot it out. Let the motion before end sooner, or raise contacts.start_overlap"
            )
            raise RunError(f"{config.document.where(where)}: walls.{where[1]}: {text}")


def unfinished(simulation: Simulation) -> list[str]:
    """Return a sentence for each wall whose present motion waited for a condition to the end of a run."""
    told = []
    for w, (name, wall) in enumerate(simulation.config.walls.items()):
        number = int(simulation.world.walls.stage[w, 0])
        stage = wall.stages[number] if number < len(wall.stages) else None
        if stage is not None and stage.until is not None and simulation.ended is None:
            what = f"motion {number + 1} of {len(wall.stages)} ({stage.motion.name})"
            told.append(
                f"walls.{name} was still in {what} at the end: its 'until' ({stage.until.name}) never held. Give the "
                "run more time, or it another condition"
            )
    return told
