"""A study file: a base scene, what is varied, how often each point is repeated, and what is expected of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, PrivateAttr, ValidationError, model_validator

from clast.config.document import Document, Problem
from clast.config.names import FolderName, Key
from clast.config.problems import located
from clast.config.quantities import to_si
from clast.config.scene import SceneConfig, load
from clast.config.yaml_loader import read_document
from clast.errors import ConfigError, KeyPath
from clast.parts.params import Params
from clast.plugins.nearest import suggestion
from clast.studies.axis_config import AxisConfig
from clast.studies.expectation_config import CURVES, Expectation
from clast.studies.measures import FROM_SUMMARY, MEASURES, unit_of

Changes = Annotated[dict[str, Any], Field(description="Key path in the scene -> value, as --set would have them")]
SPACE_FILLING = ("latin_hypercube", "sobol", "random")

QUIET = {"output.writers": [], "output.frames": 0}
"""What a run of a study leaves out, unless ``set`` says otherwise: it is one of many, and its curves tell."""


class StudyConfig(Params):
    """A study, validated; made by :func:`load_study`."""

    study: Annotated[FolderName, Field(description="Name of the study; by default that of the file")] = "study"
    description: Annotated[str, Field(description="What the study is to show")] = ""
    base: Annotated[str, Field(description="Scene file that all runs start from, relative to the study file")]
    set: Annotated[Changes, Field(description="Changes of the scene in all runs")] = Field(default_factory=dict)
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
    grain: Annotated[
        Literal["same", "per_repeat", "per_run"],
        Field(description="One packing in all runs, one for each repeat, or another one in every run"),
    ] = "same"
    expect: Annotated[tuple[Expectation, ...], Field(description="Statements that the study is to check")] = ()

    _document: Document = PrivateAttr()
    _scene: SceneConfig = PrivateAttr()

    @model_validator(mode="after")
    def _points_where_needed(self) -> StudyConfig:
        if self.design in SPACE_FILLING and self.points is None:
            raise ValueError(f"design '{self.design}' needs 'points': how many are drawn")
        if self.design not in SPACE_FILLING and self.points is not None:
            raise ValueError(f"'points' belongs to the designs {', '.join(SPACE_FILLING)}; '{self.design}' has its own")
        return self

    @property
    def document(self) -> Document:
        """The study as written."""
        return self._document

    @property
    def scene(self) -> SceneConfig:
        """The base scene, with what the command line changes."""
        return self._scene

    @property
    def of_accidents(self) -> bool:
        """Whether its points are drawn, or there is one point alone: all of its runs are a sample of something."""
        return self.design in SPACE_FILLING or not self.vary

    @property
    def variant_changes(self) -> dict[str, Mapping[str, Any]]:
        """Changes by the name of their variant; one without a name, where the study has none."""
        return dict(self.variants) or {"": {}}

    def problem(self, path: KeyPath, text: str) -> ConfigError:
        """Error for the caller to raise, with its place in the study file in front."""
        return ConfigError(self._document.report([Problem(path, text)]), at=None)


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
    document = read_document(path)
    data = dict(document.data)
    if "materials" in data and "base" not in data:
        raise ConfigError(f"{path}: this is a scene, not a study of one; run it with 'clast run {path}'")
    data.setdefault("study", Path(document.name).stem)
    try:
        study = StudyConfig.model_validate(data)
    except ValidationError as error:
        raise ConfigError(document.report(located(error, StudyConfig, document))) from None
    study._document = document
    problems = list(_unknown_names(study))
    if problems:
        raise ConfigError(document.report(problems))
    base = document.folder / study.base
    if not base.is_file():
        raise study.problem(("base",), f"{study.base!r}: no such file; the path starts at the study's folder")
    study._scene = load(base, overrides)
    if study._scene.compression is None:
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
