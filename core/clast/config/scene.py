"""Scene: one YAML file, validated against the parts that plugins offer, in SI."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, Discriminator, Field, PrivateAttr, Tag, ValidationError

from clast.config.beside import NEIGHBOURS, WALL, NeighbourChoice, WallChoice
from clast.config.boundaries import Boundaries
from clast.config.choice import Chosen, PartOf, default_part
from clast.config.conditions import blind_conditions
from clast.config.contacts import Contacts
from clast.config.document import Document, Problem
from clast.config.names import FolderName, Key
from clast.config.overrides import apply_overrides
from clast.config.plain import plain_data
from clast.config.problems import UNKNOWN_PART, located
from clast.config.references import check_references
from clast.config.sections import (
    Bonds,
    Compression,
    Material,
    Output,
    ReferencePoint,
    TimeSettings,
)
from clast.config.yaml_loader import read_document
from clast.errors import ClastError, ConfigError, KeyPath, PluginError
from clast.parts.params import Params
from clast.plugins.discovery import discover, load_file
from clast.plugins.registry import Registry

NAMED_BY_THE_USER: tuple[KeyPath, ...] = (("materials",), ("walls",), ("contacts", "pairs"))
"""Mappings to which ``--set`` and ``changed`` add nothing but whole entries."""

MOST_MATERIALS = 256
"""What the results can number with one byte a particle."""

Generators = (
    Annotated[tuple[Annotated[Chosen, PartOf("generator")], ...], Field(min_length=1), Tag("<list>")]
    | Annotated[Chosen, PartOf("generator"), Tag("<one>")]
)


def _one_or_list(given: Any) -> str:
    return "<list>" if isinstance(given, list | tuple) else "<one>"


class SceneConfig(Params):
    """A scene of granules: what they are made of, what is done to them, and what is kept.

    Made by :func:`load`, validated and in SI. Every choice of a part is a
    :class:`clast.config.choice.Chosen`, every wall a :class:`clast.config.beside.WallChoice`. ``particles``
    is a single :class:`Chosen` or a tuple of them, as written; :attr:`generators` is always a tuple.
    """

    name: Annotated[FolderName, Field(description="Name of the scene; by default that of the file")] = "scene"
    description: Annotated[str, Field(description="What the scene shows")] = ""
    plugins: Annotated[tuple[str, ...], Field(description="Python files with plugins, relative to the scene file")] = ()
    materials: Annotated[
        dict[Key, Material], Field(min_length=1, max_length=MOST_MATERIALS, description="Materials by name")
    ]
    particles: Annotated[Generators, Discriminator(_one_or_list), Field(description="One generator, or a list of them")]
    bonds: Annotated[Bonds | None, Field(description="Solid bridges between particles")] = None
    contacts: Annotated[Contacts | None, Field(description="Contact of particles and walls")] = None
    walls: Annotated[dict[Key, Annotated[WallChoice, WALL]], Field(description="Walls by name")] = Field(
        default_factory=dict
    )
    body_forces: Annotated[
        tuple[Annotated[Chosen, PartOf("body_force")], ...], Field(description="Forces that act everywhere")
    ] = ()
    boundaries: Annotated[Boundaries, Field(description="Limits of the scene")] = Boundaries()
    compression: Annotated[Compression | None, Field(description="How strain and stress are read off two plates")] = (
        None
    )
    integrator: Annotated[Chosen, PartOf("integrator"), Field(description="Time integrator")] = default_part("midstep")
    damping: Annotated[Chosen, PartOf("damping")] | None = Field(
        default=None, description="What brakes all particles, so that they come to rest; by default nothing does"
    )
    neighbours: Annotated[NeighbourChoice, NEIGHBOURS, Field(description="How neighbours are found")] = Field(
        default_factory=dict, validate_default=True
    )
    time: Annotated[TimeSettings, Field(description="Time step and end of the run")]
    stop: Annotated[
        tuple[Annotated[Chosen, PartOf("stop")], ...],
        Field(description="Conditions that end the run before its time; the first that is reached does"),
    ] = ()
    output: Annotated[Output, Field(description="What a run leaves behind")] = Field(
        default_factory=dict, validate_default=True
    )
    reference: Annotated[
        tuple[ReferencePoint, ...], Field(description="Measured crushing points, drawn beside the curve")
    ] = ()

    _document: Document = PrivateAttr()
    _registry: Registry = PrivateAttr()

    @property
    def generators(self) -> tuple[Chosen, ...]:
        """The chosen generators, in order."""
        return (self.particles,) if isinstance(self.particles, Chosen) else self.particles

    @property
    def chosen(self) -> tuple[Chosen, ...]:
        """Every part the scene uses, in the order of the sections."""
        return tuple(chosen for _, chosen in _chosen_in(self, ()))

    @property
    def document(self) -> Document:
        """The scene as written, with the line of every key."""
        return self._document

    @property
    def registry(self) -> Registry:
        """The parts the scene was validated against."""
        return self._registry

    @property
    def motions(self) -> Iterator[tuple[KeyPath, Chosen]]:
        """Every motion of a wall, with its key path."""
        return ((path, each) for path, each in _chosen_in(self.walls, ("walls",)) if each.kind == "motion")

    @property
    def conditions(self) -> Iterator[tuple[KeyPath, Chosen]]:
        """Every condition that is asked after samples: those that end the run, and those that end stages of motions."""
        found = _chosen_in({"stop": self.stop, "walls": self.walls}, ())
        return ((path, each) for path, each in found if each.kind == "stop")

    @property
    def folder(self) -> Path:
        """Folder that relative paths in the scene start from."""
        return self._document.folder

    def path_of(self, part: Chosen) -> KeyPath:
        """Key path at which a part of this scene was chosen."""
        return next(path for path, each in _chosen_in(self, ()) if each is part)

    def problem(self, place: KeyPath | str, text: str) -> ConfigError:
        """Error for the caller to raise, with its place in front.

        Parameters
        ----------
        place : key path or str
            Key path in this scene, told with file and line; or file and line of another file.
        text : str
            What is wrong, and what to do.
        """
        message = f"{place}: {text}" if isinstance(place, str) else self.remark(place, text)
        return ConfigError(message, at=None)

    def remark(self, path: KeyPath, text: str) -> str:
        """Return a text with file, line and key path in front."""
        return self._document.report([Problem(path, text)])

    @contextmanager
    def placing(self, path: KeyPath) -> Iterator[None]:
        """Put file, line and key in front of the errors that a part raises about its own keys (``ClastError.at``).

        Parameters
        ----------
        path : key path
            Where the part's keys stand in the scene.
        """
        try:
            yield
        except ClastError as error:
            if error.at is not None:
                error.args = (self._document.report([Problem((*path, *error.at), str(error))]),)
                error.at = None
            raise

    def resolved(self) -> dict[str, Any]:
        """Plain data in SI with every default written out; :func:`from_mapping` gives the same scene again.

        Paths (the scene's ``plugins``, and parameters declared as ``Path``) become absolute.
        """
        plain = plain_data(self, self.folder.resolve())
        plain["plugins"] = [str((self.folder / file).resolve()) for file in self.plugins]
        return {key: value for key, value in plain.items() if value is not None}

    def changed(self, changes: Mapping[str, Any]) -> SceneConfig:
        """Copy with values replaced, validated anew.

        Parameters
        ----------
        changes : mapping
            Key path, as ``"particles.seed"`` or ``"walls.upper.motion.velocity"`` -> value, as one would
            write it in YAML (``3``, ``"0.2 mm"``, a list, a dict).

        Raises
        ------
        ConfigError
            A path whose parent does not exist, or a value that is not allowed.
        """
        document = self._document
        for key, value in changes.items():
            written = f"change of {key!r}"
            document = document.changed(tuple(key.split(".")), value, written, NAMED_BY_THE_USER)
        return build(document)


def load(path: str | Path, overrides: Iterable[str] = (), plugins: Sequence[str | Path] = ()) -> SceneConfig:
    """Read and validate a scene file.

    Parameters
    ----------
    path : path
        A YAML file.
    overrides : iterable of str
        ``key.path=value`` each, laid over the file before it is validated.
    plugins : sequence of paths, optional
        Python files with plugins beside those that the scene names; relative to the working folder.

    Raises
    ------
    ConfigError
        All problems at once, each with file, line, column and key path.
    """
    document = apply_overrides(read_document(path), overrides, NAMED_BY_THE_USER)
    if plugins:
        named = document.data.get("plugins") or []
        more = [str(Path(file).resolve()) for file in plugins]
        document = document.changed(("plugins",), [*named, *more], "--plugin", NAMED_BY_THE_USER)
    return build(document)


def from_mapping(data: Mapping[str, Any], folder: str | Path = ".", name: str = "scene") -> SceneConfig:
    """Validate a scene that is given as plain data; ``folder`` is where relative paths start."""
    return build(Document(name, Path(folder), dict(data)))


def build(document: Document) -> SceneConfig:
    """Validate a document.

    Raises
    ------
    ConfigError
        All problems at once.
    """
    registry, not_loaded = _plugins(document)
    problems = [*not_loaded, *check_references(document.data)]
    data = dict(document.data)
    data.setdefault("name", Path(document.name).stem)
    scene = None
    try:
        scene = SceneConfig.model_validate(data, context={"registry": registry, "folder": document.folder})
    except ValidationError as error:
        found = located(error, SceneConfig, document)
        # what a file that was not loaded would have brought cannot be missed
        problems += [each for each in found if not (not_loaded and each.kind == UNKNOWN_PART)]
    if scene is not None:
        problems += blind_conditions(scene.conditions, scene.walls, scene.compression is not None)
    if problems or scene is None:
        raise ConfigError(document.report(problems))
    scene._document, scene._registry = document, registry
    return scene


def _plugins(document: Document) -> tuple[Registry, list[Problem]]:
    """Registry with the scene's own plugin files; a file that fails is a problem at its place in the list."""
    registry, problems = discover(), []
    listed = document.data.get("plugins")
    for index, file in enumerate(listed if isinstance(listed, list | tuple) else ()):
        if isinstance(file, str):
            try:
                load_file(document.folder / file, registry)
            except PluginError as error:
                problems.append(Problem(("plugins", index), str(error)))
    return registry, problems


def _chosen_in(value: Any, path: KeyPath) -> Iterator[tuple[KeyPath, Chosen]]:
    """Every part below a value, with the key path at which it was chosen."""
    if isinstance(value, Chosen):
        yield path, value
        yield from _chosen_in(value.params, path)
    elif isinstance(value, WallChoice):
        yield from _chosen_in(value.shape, path)
        for k, stage in enumerate(value.stages):
            at = (*path, "motion", k) if value.listed else (*path, "motion")
            yield from _chosen_in(stage.motion, at)
            yield from _chosen_in(stage.until, (*at, "until"))
    elif isinstance(value, NeighbourChoice):
        yield from _chosen_in(value.search, path)
    elif isinstance(value, BaseModel):
        yield from _chosen_in({name: getattr(value, name) for name in type(value).model_fields}, path)
    elif isinstance(value, Mapping):
        for key, inner in value.items():
            yield from _chosen_in(inner, (*path, key))
    elif isinstance(value, list | tuple):
        for index, inner in enumerate(value):
            yield from _chosen_in(inner, (*path, index))
