"""Stops: asking a scene's conditions, after every sample, whether its run is over, or a stage of a wall's motion."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from clast.config.choice import Chosen
from clast.config.scene import SceneConfig
from clast.ended import Ended
from clast.parts.stop import UNBALANCE
from clast.results.stages import Stages
from clast.results.unbalance import unbalanced_force_ratio
from clast.simulation import Simulation

COMPUTED = {UNBALANCE: unbalanced_force_ratio}
"""What is computed only where a condition asks for it."""


class Stops:
    """The conditions of a scene, and the samples they look at.

    Parameters
    ----------
    config : SceneConfig
    """

    def __init__(self, config: SceneConfig) -> None:
        self.chosen: tuple[Chosen, ...] = config.stop
        self.stages = Stages(config)
        asked = [each for _, each in config.conditions]
        self.any = bool(asked)
        self.columns = tuple(dict.fromkeys(name for each in asked for name in each.part.columns))
        self.seen: dict[str, list[float]] = {}

    def extra(self, simulation: Simulation) -> dict[str, float]:
        """Return the columns of a sample that only conditions ask for."""
        return {name: COMPUTED[name](simulation) for name in self.columns}

    def recall(self, curves: Mapping[str, NDArray[Any]]) -> None:
        """Remember the samples of the run that is gone on with."""
        self.seen = {name: list(map(float, values)) for name, values in curves.items()} if self.any else {}

    def look(self, simulation: Simulation, row: Mapping[str, float]) -> None:
        """Note a sample, and end the run, or a stage of a wall's motion, where its condition is reached."""
        if not self.any:
            return
        for name, value in row.items():
            self.seen.setdefault(name, []).append(float(value))
        curves = {name: np.array(values) for name, values in self.seen.items()}
        for each in self.chosen:
            told = each.part.reached(each.params, curves)
            if told is not None:
                simulation.end_here(Ended(each.name, told))
                return
        self.stages.look(simulation, curves)
