"""Overrides: ``key.path=value`` from the command line, laid over a scene file."""

from __future__ import annotations

from collections.abc import Collection, Iterable

import yaml

from clast.config.document import Document
from clast.config.yaml_loader import parse_value
from clast.errors import ConfigError, KeyPath


def apply_overrides(document: Document, overrides: Iterable[str], closed: Collection[KeyPath] = ()) -> Document:
    """Lay overrides over a document, in the order given.

    Parameters
    ----------
    document : Document
    overrides : iterable of str
        Each ``key.path=value``; the value is YAML, entries of lists are numbered from 0.
    closed : collection of key paths
        Mappings whose keys are names that the user chose; see :meth:`Document.changed`.

    Raises
    ------
    ConfigError
        An override without ``=`` or key, a value that is not YAML, or a path that leads nowhere.

    Examples
    --------
    >>> from pathlib import Path
    >>> scene = Document("scene", Path(), {"time": {"step": 1}})
    >>> apply_overrides(scene, ["time.step=5e-7"]).data
    {'time': {'step': 5e-07}}
    """
    for override in overrides:
        key, equals, text = override.partition("=")
        written = f"--set {override}"
        path = tuple(key.strip().split("."))
        if not equals or not all(path):
            raise ConfigError(f"{written}: write it as key.path=value, for instance particles.seed=3")
        try:
            value = parse_value(text)
        except yaml.YAMLError as error:
            problem = getattr(error, "problem", None) or error
            raise ConfigError(f"{written}: the value is not valid YAML: {problem}") from None
        document = document.changed(path, value, written, closed)
    return document
