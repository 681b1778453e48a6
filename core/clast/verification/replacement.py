"""What a user puts into the scenes of the cases: parts in the place of Clast's own, plugins, other values."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from clast.config.document import Document
from clast.config.overrides import apply_overrides
from clast.config.scene import NAMED_BY_THE_USER, SceneConfig, build
from clast.errors import ConfigError

PLACES = {"contact_law": ("contacts", "law"), "bond_model": ("bonds", "model"), "integrator": ("integrator",)}
"""Kinds of parts that can be replaced, and where a scene names them."""

LEFT_OUT = ("bonds", "contacts", "walls", "body_forces", "compression")
"""Sections that some scenes do without; what changes a missing one is meant for other scenes."""


@dataclass(frozen=True)
class Replacement:
    """What a user puts into the scenes.

    Attributes
    ----------
    parts : mapping
        Kind of part (a key of ``PLACES``) -> name of the part that takes the place of a scene's own; parameters that
        both know are kept.
    plugins : tuple of Path
        Python files with plugins.
    overrides : tuple of str
        ``key.path=value`` each, for the scenes that have the section.
    """

    parts: Mapping[str, str] = field(default_factory=dict)
    plugins: tuple[Path, ...] = ()
    overrides: tuple[str, ...] = ()

    def into(self, scene: SceneConfig) -> SceneConfig:
        """Return a scene with everything put in.

        Raises
        ------
        ConfigError
            A plugin cannot be loaded, a part does not exist or lacks parameters, an override is wrong.
        """
        if self.plugins:
            scene = scene.changed({"plugins": [str(file.resolve()) for file in self.plugins]})
        document = scene.document
        for kind, name in self.parts.items():
            if concerns(PLACES[kind][0], document):
                document = with_part(scene, document, kind, name)
        overrides = [each for each in self.overrides if concerns(section(each), document)]
        document = apply_overrides(document, overrides, NAMED_BY_THE_USER)
        return scene if document is scene.document else build(document)

    def refuse_idle(self, scenes: Iterable[SceneConfig]) -> None:
        """Refuse what changes none of the scenes.

        Raises
        ------
        ConfigError
        """
        documents = [scene.document for scene in scenes]
        given = {f"--set {each}": section(each) for each in self.overrides}
        given |= {f"{option(kind)} {name}": PLACES[kind][0] for kind, name in self.parts.items()}
        for text, wanted in given.items():
            if not any(concerns(wanted, document) for document in documents):
                raise ConfigError(f"{text}: none of the chosen cases has {wanted}; 'clast verify --list' shows all")


def option(kind: str) -> str:
    """Return the command line's option for a kind of part.

    >>> option("contact_law")
    '--contact-law'
    """
    return f"--{kind.replace('_', '-')}"


def section(override: str) -> str:
    """Return the section of a scene that an override changes.

    >>> section("contacts.law.stiffness=1e5")
    'contacts'
    """
    return override.partition("=")[0].split(".")[0].strip()


def concerns(wanted: str, document: Document) -> bool:
    """Tell whether a change of a section means a scene."""
    return wanted in document.data or wanted not in LEFT_OUT


def with_part(scene: SceneConfig, document: Document, kind: str, name: str) -> Document:
    """Return the document with another part of a kind, which keeps the parameters that it knows."""
    place, known = PLACES[kind], scene.registry.get(kind, name).part.Params.model_fields
    before = document.get(place) if document.has(place) else name
    kept = {key: value for key, value in before.items() if key in known} if isinstance(before, Mapping) else {}
    return document.changed(place, {**kept, "type": name}, f"{option(kind)} {name}")
