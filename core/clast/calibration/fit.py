"""Fitting: points that fill the space, then points that promise most, then the optimum; nothing is computed twice."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from clast.calibration.config import CalibrationConfig
from clast.calibration.identify import Identified, identify
from clast.calibration.layout import ASKED
from clast.calibration.one_thread import one_thread
from clast.calibration.proposal import misfit, next_points, optimum
from clast.calibration.responses import Goal, Response, goals, respond
from clast.calibration.surrogate import Surrogate, fit
from clast.config.scene import SceneConfig
from clast.errors import ConfigError
from clast.studies.axis import Axis
from clast.studies.conduct import Audience, conduct, states
from clast.studies.design import Point, quantiles
from clast.studies.executors import Workers
from clast.studies.prepare import settle
from clast.studies.table import Row, Table, gather
from clast.studies.tasks import at_point, changed, repeated

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Fit:
    """What a calibration found.

    Attributes
    ----------
    config : CalibrationConfig
    axes : list of Axis
    goals : list of Goal
    shares : (n, d) float64
        All points, in the unit cube; the last is where the optimum was expected.
    rows : list
        The runs of each point.
    responses : list
        Of each point, one a goal.
    surrogate : Surrogate
    best : int
        Number of the point with the smallest expected misfit.
    identified : Identified
    """

    config: CalibrationConfig
    axes: Sequence[Axis]
    goals: Sequence[Goal]
    shares: Floats
    rows: Sequence[Sequence[Row]]
    responses: Sequence[Sequence[Response]]
    surrogate: Surrogate
    best: int
    identified: Identified

    @property
    def point(self) -> Point:
        """The settings that were found."""
        return self.settings(self.shares[self.best])

    @property
    def table(self) -> Table:
        """All runs."""
        return Table([row for rows in self.rows for row in rows])

    @property
    def scene(self) -> SceneConfig:
        """The scene with the parameters that were found."""
        named = {"name": self.config.calibration, **self.config.set}
        scene = changed(self.config, self.config.scene, named, ("set",))
        return at_point(self.config, scene, self.point, "parameters")

    def settings(self, shares: Floats) -> Point:
        """Return the settings at a point of the unit cube."""
        return tuple(axis.at(float(share)) for axis, share in zip(self.axes, shares, strict=True))

    def expected(self) -> tuple[Floats, Floats]:
        """Return means and deviations of the residuals at the best point, as the surrogate has them."""
        mean, deviation = self.surrogate.predict(self.shares[self.best][None])
        return mean[0], deviation[0]


class Fitting:
    """A calibration on its way.

    Parameters
    ----------
    config : CalibrationConfig
    folder : Path
        Of the runs; what is done in it is not repeated, so that a calibration which was stopped goes on.
    workers : Workers
    audience : Audience
    """

    def __init__(self, config: CalibrationConfig, folder: Path, workers: Workers, audience: Audience) -> None:
        self.config, self.folder, self.workers, self.audience = config, folder, workers, audience
        self.axes = [self._axis(name) for name in config.parameters]
        self.goals = goals(config)
        self.scene = changed(config, config.scene, config.changes, ("set",))
        self.shares: list[Floats] = []
        self.rows: list[list[Row]] = []

    def _axis(self, name: str) -> Axis:
        try:
            return Axis(name, self.config.parameters[name])
        except ValueError as error:
            raise self.config.problem(("parameters", name), str(error)) from None

    @one_thread()
    def fit(self) -> Fit:
        """Run all points of the budget and return what they say.

        Raises
        ------
        ClastError
            With a message for the user.
        """
        first = quantiles("sobol", self.config.first_points, len(self.axes), self.config.seed)
        self._run(list(first))
        for shares in self._improving():
            self._run(shares)
        surrogate, known = self._surrogate(), np.array(self.shares)
        best = int(np.argmin(misfit(surrogate.predict(known)[0])))
        responses = self._responses()
        error = np.array([each.error / goal.scale for each, goal in zip(responses[best], self.goals, strict=True)])
        noise = np.maximum(np.nan_to_num(error), 1.0)
        identified = identify(surrogate.slopes(known[best]), noise)
        return Fit(self.config, self.axes, self.goals, known, self.rows, responses, surrogate, best, identified)

    def _improving(self) -> Iterator[list[Floats]]:
        """Return the points after the first, some at a time, chosen by all that is known; the last is the optimum."""
        while (left := self.config.points - len(self.shares)) > 0:
            surrogate, known, seed = self._surrogate(), np.array(self.shares), self.config.seed + len(self.shares)
            if left == 1:
                yield [optimum(surrogate, known, seed)]
            else:
                yield next_points(surrogate, known, min(self.config.together, left - 1), seed)

    def _surrogate(self) -> Surrogate:
        try:
            return fit(np.array(self.shares), self._responses(), self.goals)
        except ConfigError as error:
            reasons = [row.reason for rows in self.rows for row in rows if row.reason]
            raise ConfigError(f"{error}; runs fail: {reasons[0]}" if reasons else str(error)) from None

    def _responses(self) -> list[list[Response]]:
        return [[respond(self.config, goal, rows) for goal in self.goals] for rows in self.rows]

    def _run(self, shares: Sequence[Floats]) -> None:
        """Run all repeats of some points."""
        config, tasks = self.config, []
        for share in shares:
            number = len(self.shares)
            point = tuple(axis.at(float(x)) for axis, x in zip(self.axes, share, strict=True))
            scene = at_point(config, self.scene, point, "parameters")
            tasks += repeated(scene, "", number, point, config.repeats, config.grain)
            self.shares.append(np.asarray(share))
        settle(self.folder, config.document, config.calibration, tasks, ASKED)
        names = [task.name for task in tasks]
        results = conduct(self.folder, names, self.workers, self.audience)
        rows = gather(self.folder, tasks, states(self.folder, names, results)).rows
        for number in range(len(self.rows), len(self.shares)):
            self.rows.append([row for row in rows if row.task.point == number])
