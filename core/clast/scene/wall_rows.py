"""Rows of walls: the numbers of their shapes, and of every stage of their motions, as the compiled loop takes them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from clast.config.choice import Chosen
from clast.engine.blueprint import Blueprint
from clast.engine.long_records import long_row
from clast.engine.state import Floats
from clast.scene.plan import wall_shapes
from clast.scene.scene import Scene


class CourseRow(NamedTuple):
    """Number of a motion among those of the scene, and the numbers of its course."""

    kind: int
    row: list[float]


class WallRows(NamedTuple):
    """Shapes (w, …) as a table, the courses of each wall's stages, and what they have of any length."""

    shapes: Floats
    courses: list[list[CourseRow]]
    lists: Floats

    @property
    def width(self) -> int:
        """Numbers of the longest course."""
        return max([0, *(len(course.row) for courses in self.courses for course in courses)])


def wall_rows(scene: Scene, plan: Blueprint) -> WallRows:
    """Return the rows of all walls of a scene; each wall's last course is that of rest."""
    lists: list[float] = []
    shapes = [long_row(shape, lists) for _, shape in wall_shapes(scene)]
    courses = [[_course(plan, stage.motion, lists) for stage in wall.stages] for wall in scene.config.walls.values()]
    rest = CourseRow(len(plan.motions), [])
    return WallRows(padded(shapes, max([0, *map(len, shapes)])), [[*each, rest] for each in courses], np.array(lists))


def _course(plan: Blueprint, motion: Chosen, lists: list[float]) -> CourseRow:
    return CourseRow(plan.motions.index(motion.part), long_row(motion.part.course(motion.params), lists))


def padded(rows: list[list[float]], width: int) -> Floats:
    """Return rows of different lengths as a table, (rows, width), filled up with zeros."""
    table = np.zeros((len(rows), width))
    for k, row in enumerate(rows):
        table[k, : len(row)] = row
    return table
