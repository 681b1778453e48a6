"""A file that asks for many runs of one scene: a study, or a calibration."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

from pydantic import Field, PrivateAttr, ValidationError

from clast.config.document import Document, Problem
from clast.config.problems import located
from clast.config.scene import SceneConfig, load
from clast.config.yaml_loader import read_document
from clast.errors import ConfigError, KeyPath
from clast.parts.params import Params

Changes = Annotated[dict[str, Any], Field(description="Key path in the scene -> value, as --set would have them")]

Grain = Annotated[
    Literal["same", "per_repeat", "per_run"],
    Field(description="One packing in all runs, one for each repeat, or another one in every run"),
]

QUIET = {"output.writers": [], "output.frames": 0}
"""What a run leaves out, unless someone says otherwise: it is one of many, and its curves tell."""


class Asking(Params):
    """What every such file says, validated; made by :func:`read_asking`."""

    base: Annotated[str, Field(description="Scene file that all runs start from, relative to this file")]
    set: Annotated[Changes, Field(description="Changes of the scene in all runs")] = Field(default_factory=dict)
    grain: Grain = "same"

    _document: Document = PrivateAttr()
    _scene: SceneConfig = PrivateAttr()

    @property
    def document(self) -> Document:
        """The file as written."""
        return self._document

    @property
    def scene(self) -> SceneConfig:
        """The base scene, with what the command line changes."""
        return self._scene

    @property
    def changes(self) -> dict[str, Any]:
        """Changes of the scene in all runs, with what such a run leaves out."""
        given = self._scene.document.overridden
        quiet = {key: value for key, value in QUIET.items() if tuple(key.split(".")) not in given}
        return quiet | self.set

    def problem(self, path: KeyPath, text: str) -> ConfigError:
        """Error for the caller to raise, with its place in the file in front."""
        return ConfigError(self._document.report([Problem(path, text)]), at=None)

    def sets(self) -> Iterator[str]:
        """Return the keys of the scene that the file itself gives a value to."""
        yield from self.set

    def problems(self) -> Iterator[Problem]:
        """Return what is wrong although every value by itself is right; called before the scene is read."""
        yield from ()


Asked = TypeVar("Asked", bound=Asking)


def read_asking(model: type[Asked], name: str, document: Document, overrides: Iterable[str]) -> Asked:
    """Validate a file that asks for runs, and read the scene it starts from.

    Parameters
    ----------
    model : type
        What the file has to be.
    name : str
        Its key that names it; by default it is named as its file.
    document : Document
    overrides : iterable of str
        ``key.path=value`` each, laid over the base scene.

    Raises
    ------
    ConfigError
        All problems at once, each with its place.
    """
    data = {name: Path(document.name).stem, **document.data}
    try:
        found = model.model_validate(data)
    except ValidationError as error:
        raise ConfigError(document.report(located(error, model, document))) from None
    found._document = document
    problems = list(found.problems())
    if problems:
        raise ConfigError(document.report(problems))
    base = document.folder / found.base
    if not base.is_file():
        raise found.problem(("base",), f"{found.base!r}: no such file; the path starts at the folder of this file")
    given = list(overrides)
    _refuse_what_is_no_scene(model, document, given)
    found._scene = load(base, given)
    _refuse_what_is_lost(found)
    return found


def _refuse_what_is_no_scene(model: type[Asking], document: Document, overrides: Iterable[str]) -> None:
    """Refuse to change on the command line what only the file that asks for runs has."""
    for override in overrides:
        key = override.partition("=")[0].strip().split(".")[0]
        if key in model.model_fields and key not in SceneConfig.model_fields:
            raise ConfigError(
                f"--set {override}: changes the scene that all runs start from, and {key!r} is no key of it; "
                f"change it in {document.name}"
            )


def _refuse_what_is_lost(found: Asking) -> None:
    """Refuse to change on the command line what the file sets anyway."""
    for key in found.sets():
        written = found.scene.document.overridden.get(tuple(key.split(".")))
        if written is not None:
            raise ConfigError(f"{written}: {found.document.name} sets this key itself; change it there")


def read_for(path: str | Path, foreign: Iterable[str], needed: str, advice: str) -> Document:
    """Read a YAML file, unless it is another kind of file than was asked for.

    Parameters
    ----------
    path : path
    foreign : iterable of str
        Keys that other kinds of files have.
    needed : str
        A key that only the right kind has.
    advice : str
        What the file is instead, and what to do.

    Raises
    ------
    ConfigError
        With this advice.
    """
    document = read_document(path)
    if needed not in document.data and document.data.keys() & {*foreign}:
        raise ConfigError(f"{path}: {advice}")
    return document
