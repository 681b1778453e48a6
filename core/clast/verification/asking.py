"""Asking a scene's conditions while a case runs, as a run does after its samples."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from clast.results.stops import Stops
from clast.simulation import Simulation

Row = Mapping[str, float]


def nothing(simulation: Simulation) -> Row:
    """Return no column."""
    return {}


class Asking:
    """Observer that asks the conditions after every so many steps.

    Parameters
    ----------
    simulation : Simulation
    every : int
    read : (simulation) -> mapping, optional
        Columns of the curves that the conditions look at, beside those computed for them.

    Attributes
    ----------
    rows : list of mapping
        What they were told.
    """

    def __init__(self, simulation: Simulation, every: int, read: Callable[[Simulation], Row] = nothing) -> None:
        self.stops, self.every, self.read = Stops(simulation.config), every, read
        self.rows: list[Row] = []

    def next_step(self, step: int) -> int | None:
        """Return the next step to look at."""
        return (step // self.every + 1) * self.every

    def observe(self, simulation: Simulation) -> None:
        """Ask the conditions."""
        row = {**self.stops.extra(simulation), **self.read(simulation)}
        self.rows.append(row)
        self.stops.look(simulation, row)
