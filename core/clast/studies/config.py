"""A study file: a base scene, what is varied, how often each point is repeated, and what is expected of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from clast.config.document import Problem
from clast.config.names import FolderName, Key
from clast.config.quantities import to_si
from clast.plugins.nearest import suggestion
from clast.studies.asking import Asking, Changes, read_asking, read_for
from clast.studies.axis_config import AxisConfig
from clast.studies.expectation_config import CURVES, Expectation
from clast.studies.measures import FROM_SUMMARY, MEASURES, unit_of

SPACE_FILLING = ("latin_hypercube", "sobol", "random")


class StudyConfig(Asking):
    """A study, validated; made by :func:`load_study`."""

    study: Annotated[FolderName, Field(description="Name of the study; by default that of the file")] = "study"
    description: Annotated[str, Field(description="What the study is to show")] = ""
    variants: Annotated[
        dict[Key, Changes], Field(description="Named sets of changes; the whole study is made with each")
    ] = Field(default_factory=dict)
    vary: Annotated[dict[str, AxisConfig], Field(description="What is varied: key path in the scene -> values")] = (
        Field(default_factory=dict)
    )
    design: Annotated[
        Literal["grid", "together", "latin_hypercube", "sobol", "random"],
        Field(description="All combinations, values side by side, or points that fill the space"),
    ] = "grid"
    points: Annotated[int | None, Field(ge=1, le=100_000, description="How many points fill the space")] = None
    seed: Annotated[int, Field(ge=0, description="Seed of points that are drawn")] = 1
    repeats: Annotated[int, Field(ge=1, le=10_000, description="Runs a point, with other seeds each")] = 1
    expect: Annotated[tuple[Expectation, ...], Field(description="Statements that the study is to check")] = ()

    @model_validator(mode="after")
    def _points_where_needed(self) -> StudyConfig:
        if self.design in SPACE_FILLING and self.points is None:
            raise ValueError(f"design '{self.design}' needs 'points': how many are drawn")
        if self.design not in SPACE_FILLING and self.points is not None:
            raise ValueError(f"'points' belongs to the designs {', '.join(SPACE_FILLING)}; '{self.design}' has its own")
        return self

    @property
    def of_accidents(self) -> bool:
        """Whether its points are drawn, or there is one point alone: all of its runs are a sample of something."""
        return self.design in SPACE_FILLING or not self.vary

    @property
    def variant_changes(self) -> dict[str, Mapping[str, Any]]:
        """Changes by the name of their variant; one without a name, where the study has none."""
        return dict(self.variants) or {"": {}}

    def sets(self) -> Iterator[str]:
        """Return the keys of the scene that the study itself gives a value to."""
        yield from self.set
        for changes in self.variants.values():
            yield from changes
        for name, axis in self.vary.items():
            yield from axis.sets(name)

    def problems(self) -> Iterator[Problem]:
        """Names in statements that are no axis, no variant and no measure."""
        yield from _unknown_names(self)


def load_study(path: str | Path, overrides: Iterable[str] = ()) -> StudyConfig:
    """Read and validate a study file, and the scene it starts from.

    Parameters
    ----------
    path : path
        A YAML file.
    overrides : iterable of str
        ``key.path=value`` each, laid over the base scene.

    Raises
    ------
    ConfigError
        All problems at once, each with its place.
    """
    advice = f"this is a scene, not a study of one; run it with 'clast run {path}'"
    study = read_asking(StudyConfig, "study", read_for(path, ("materials",), "base", advice), overrides)
    if study.scene.compression is None:
        for k, each in enumerate(study.expect):
            if each.measure not in FROM_SUMMARY:
                text = f"{study.base!r} has no 'compression', so there is no {each.measure}"
                raise study.problem(("expect", k, "measure"), text)
    return study


def _unknown_names(study: StudyConfig) -> Iterator[Problem]:
    """Names in statements that are no axis, no variant and no measure."""
    measures = [CURVES, *MEASURES, *FROM_SUMMARY]
    for k, each in enumerate(study.expect):
        axes = [("along", each.along)] if each.along else []
        axes += [(key, axis) for key in ("where", "than") for axis in getattr(each, key)]
        for key, axis in axes:
            if axis not in study.vary:
                yield Problem(("expect", k, key), f"{axis!r} is not varied; {suggestion(axis, study.vary)}")
        for variant in each.variants:
            if variant not in study.variants:
                text = f"there is no variant {variant!r}; {suggestion(variant, study.variants)}"
                yield Problem(("expect", k, "variants"), text)
        if each.value is not None and each.measure in measures:
            try:
                to_si(each.value, unit_of(each.measure))
            except ValueError as error:
                yield Problem(("expect", k, "value"), str(error))
        if each.measure not in measures:
            text = f"{each.measure!r} is no measure; {suggestion(each.measure, measures)}"
            yield Problem(("expect", k, "measure"), text)
        if each.check in ("grows", "falls") and each.along is None and len(study.vary) != 1:
            yield Problem(("expect", k), f"{len(study.vary)} axes are varied; say with 'along' which one is meant")
