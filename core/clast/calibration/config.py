"""A calibration file: a base scene, parameters with bounds, measured targets, and a budget of runs."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from clast.config.document import Problem
from clast.config.names import FolderName
from clast.config.quantities import Number, read_quantity, to_si
from clast.parts.params import Params
from clast.plugins.nearest import suggestion
from clast.studies.asking import Asking, Grain, read_asking, read_for
from clast.studies.axis_config import AxisConfig, Given
from clast.studies.measures import FROM_SUMMARY, MEASURES, unit_of

LEAST_POINTS = 3
"""Points without which nothing can be fitted."""

RUNS_OUT = 16
"""Runs that are out at a time where a file does not say how many points are chosen at once."""

ROUNDS = 4
"""How often, at least, points are then chosen anew."""

CURVE = "curve"
"""Name of the target that is a whole stress-strain curve."""


class Target(Params):
    """What was measured, and how closely it is to be met."""

    value: Annotated[Given | None, Field(description="Mean of the measure")] = None
    within: Annotated[
        Number, Field(gt=0, description="Distance from the value that counts as one, as a share of it")
    ] = 0.05
    scatter: Annotated[Given | None, Field(description="Standard deviation between grains")] = None
    scatter_within: Annotated[Number, Field(gt=0, description="Tolerance of the scatter, as a share of it")] = 0.2
    file: Annotated[str | None, Field(description="CSV file with the columns strain and stress_Pa, for 'curve'")] = None

    @model_validator(mode="after")
    def _something(self) -> Target:
        if self.value is None and self.scatter is None and self.file is None:
            raise ValueError("a target needs data: 'value', 'scatter', or for 'curve' a 'file'")
        return self


class CalibrationConfig(Asking):
    """A calibration, validated; made by :func:`load_calibration`."""

    calibration: Annotated[FolderName, Field(description="Name; by default that of the file")] = "calibration"
    description: Annotated[str, Field(description="What is fitted to what")] = ""
    parameters: Annotated[
        dict[str, AxisConfig], Field(min_length=1, max_length=12, description="What is fitted: key -> bounds")
    ]
    targets: Annotated[dict[str, Target], Field(min_length=1, description="What was measured: measure -> target")]
    repeats: Annotated[int, Field(ge=1, le=1000, description="Runs a point, with other seeds each")] = 3
    grain: Grain = "per_repeat"
    budget: Annotated[int, Field(ge=4, le=1_000_000, description="Runs in all")]
    first: Annotated[Number, Field(gt=0, lt=1, description="Share of the budget for points that fill the space")] = 0.5
    at_once: Annotated[
        int | None,
        Field(ge=1, le=1000, description="Points chosen at a time, once the first ones fill the space"),
    ] = None
    seed: Annotated[int, Field(ge=0, description="Seed of the points")] = 1

    @property
    def points(self) -> int:
        """How many points the budget allows."""
        return self.budget // self.repeats

    @property
    def first_points(self) -> int:
        """How many of them fill the space."""
        return max(LEAST_POINTS, round(self.first * self.points))

    @property
    def together(self) -> int:
        """How many points are chosen at a time; by default so few that most are chosen by what others gave.

        It does not depend on the workers, because the points that are chosen depend on it.
        """
        return self.at_once or max(1, min(RUNS_OUT // self.repeats, (self.points - self.first_points) // ROUNDS))

    def sets(self) -> Iterator[str]:
        """Return the keys of the scene that the calibration itself gives a value to."""
        yield from self.set
        for name, axis in self.parameters.items():
            yield from axis.sets(name)

    def problems(self) -> Iterator[Problem]:
        """Bounds, names, units and budgets that cannot be."""
        yield from _problems(self)

    def measured_curve(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return strain and stress in Pa of the target curve, (s,) each.

        Raises
        ------
        ConfigError
            There is no such file, or it has no such columns of numbers.
        """
        name = self.targets[CURVE].file or ""
        place = (("targets", CURVE, "file"), self.document.folder / name)
        try:
            with place[1].open(newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            strain, stress = (np.array([float(row[key]) for row in rows]) for key in ("strain", "stress_Pa"))
        except OSError as error:
            raise self.problem(place[0], f"{name!r} cannot be read: {error.strerror}") from None
        except (KeyError, ValueError, TypeError) as error:
            raise self.problem(
                place[0], f"{name!r}: needs columns of numbers 'strain' and 'stress_Pa'; {error}"
            ) from None
        if len(strain) < 2 or (np.diff(strain) <= 0.0).any():
            raise self.problem(place[0], f"{name!r}: needs two rows or more, with strains that grow")
        return strain, stress


def load_calibration(path: str | Path, overrides: Iterable[str] = ()) -> CalibrationConfig:
    """Read and validate a calibration file, and the scene it starts from.

    Raises
    ------
    ConfigError
        All problems at once, each with its place.
    """
    advice = "this is a scene or a study, not a calibration, which has 'parameters' and 'targets'"
    document = read_for(path, ("materials", "vary"), "targets", advice)
    found = read_asking(CalibrationConfig, "calibration", document, overrides)
    if CURVE in found.targets:
        found.measured_curve()
    return found


def _backwards(axis: AxisConfig) -> bool:
    try:
        return read_quantity(axis.start)[0] >= read_quantity(axis.to)[0]
    except ValueError:
        return False  # is told when the axis is made


def _problems(config: CalibrationConfig) -> Iterator[Problem]:
    known = [CURVE, *MEASURES, *FROM_SUMMARY]
    for name, axis in config.parameters.items():
        if axis.start is None:
            yield Problem(("parameters", name), "a parameter needs bounds: 'from' and 'to'")
        elif _backwards(axis):
            yield Problem(("parameters", name), f"'from' ({axis.start}) must be below 'to' ({axis.to})")
    for name, target in config.targets.items():
        if name not in known:
            yield Problem(("targets", name), f"{name!r} is no measure; {suggestion(name, known)}")
        if (name == CURVE) != (target.file is not None):
            yield Problem(("targets", name), "'file' belongs to the target 'curve', and 'curve' needs it")
        if target.scatter is not None and config.repeats < 3:
            yield Problem(("repeats",), f"scatter of {name} cannot be told from {config.repeats} runs; take 3 or more")
        for key in ("value", "scatter"):
            given = getattr(target, key)
            try:
                if given is not None and to_si(given, unit_of(name)) == 0.0:
                    yield Problem(("targets", name, key), "must not be 0: 'within' is a share of it")
            except ValueError as error:
                yield Problem(("targets", name, key), str(error))
    if config.points < 4:
        text = f"{config.budget} runs are {config.points} points of {config.repeats}; at least 4 points are needed"
        yield Problem(("budget",), text)
